// The scene that is made for a particle file, as text.
#include "render/apps/job/particle_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/apps/job/options/look_values.h"

namespace boule {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string scene_of(const LookOptions& look, const std::optional<LookFloor>& floor = {}) {
  return look_scene("run.xyz", look, floor);
}

TEST(ParticleLook, HasExactlyTheOptions) {
  EXPECT_THAT(scene_of({}), HasSubstr("[[particles]]\n"
                                      "file = \"run.xyz\"\n"
                                      "material = \"particles\"\n\n"));
  LookOptions look;
  look.format = "dump";
  look.columns = {"x", "-", "z"};
  look.frame = -3;
  look.water = true;
  look.topology = "run.psf";
  look.radius = "0.50";
  look.radii = {{"Na", "1.02"}};
  look.scale = 0.1;
  look.select = "name == \"CA\"";
  look.color = "|v|";
  look.map = "#000000,#ff8000";
  look.range = {{-1, 2.5}};
  look.colors = {{"O", "crimson"}, {"a\"b", "#336699"}};
  look.nan_color = "white";
  look.wrap = true;
  look.unwrap = true;
  look.boundary = true;
  look.replicate = {{2, 1, 3}};
  EXPECT_THAT(scene_of(look), HasSubstr("file = \"run.xyz\"\n"
                                        "format = \"dump\"\n"
                                        "columns = [\"x\", \"-\", \"z\"]\n"
                                        "frame = -3\n"
                                        "water = true\n"
                                        "topology = \"run.psf\"\n"
                                        "radius = 0.50\n"
                                        "radii = { \"Na\" = 1.02 }\n"
                                        "scale = 0.1\n"
                                        "select = \"name == \\\"CA\\\"\"\n"
                                        "wrap = true\n"
                                        "unwrap = true\n"
                                        "boundary = true\n"
                                        "replicate = [2, 1, 3]\n"
                                        "material = \"particles\"\n"
                                        "colors = { \"O\" = \"crimson\", \"a\\\"b\" = "
                                        "\"#336699\" }\n"
                                        "nan_color = \"white\"\n"
                                        "[particles.color]\n"
                                        "by = \"|v|\"\n"
                                        "map = [\"#000000\", \"#ff8000\"]\n"
                                        "range = [-1, 2.5]\n\n"));
}

TEST(ParticleLook, HasClipPlanes) {
  LookOptions look;
  EXPECT_THAT(scene_of(look), Not(HasSubstr("[[clip]]")));
  look.clip = {{{5, 0, 0}, {1, 0, 0}}, {{0, 0.5, 0}, {0, -1, 0}}};
  EXPECT_THAT(scene_of(look), HasSubstr("\n[[clip]]\npoint = [5, 0, 0]\nnormal = [1, 0, 0]\n"
                                        "\n[[clip]]\npoint = [0, 0.5, 0]\nnormal = [0, -1, 0]\n"));
}

TEST(ParticleLook, HasGhosts) {
  LookOptions look;
  look.ghost = "chain != 'L'";
  look.opacity = 0.25;
  EXPECT_THAT(scene_of(look), HasSubstr("\nghost = \"chain != 'L'\"\nopacity = 0.25\n"));
}

TEST(ParticleLook, HasTheOptionsOfBonds) {
  LookOptions look;
  look.style = ParticleShape::balls_and_sticks;
  look.bonds = "1.80";
  look.bond_radius = 0.1;
  look.bond_color = "Silver";
  look.outline_by = "chain";
  look.cell_edges = true;
  look.axes = true;
  look.arrows = {"fx", "fy", "fz"};
  look.arrow_scale = 2;
  EXPECT_THAT(scene_of(look), HasSubstr("style = \"balls-and-sticks\"\n"
                                        "bonds = 1.80\n"
                                        "bond_radius = 0.1\n"
                                        "bond_color = \"Silver\"\n"
                                        "outline_by = \"chain\"\n"
                                        "cell_edges = true\n"
                                        "axes = true\n"
                                        "arrows = [\"fx\", \"fy\", \"fz\"]\n"
                                        "arrow_scale = 2\n"));
  look.bonds = "auto";
  look.arrows = {"f"};
  EXPECT_THAT(scene_of(look), HasSubstr("\nbonds = \"auto\"\n"));
  EXPECT_THAT(scene_of(look), HasSubstr("\narrows = \"f\"\n"));
}

TEST(ParticleLook, ColorsOfOneKindStandByThemselves) {
  LookOptions look;
  for (const char* color : {"element", "species", "#4080c0", "red green blue"}) {
    look.color = color;
    EXPECT_FALSE(has_color_map(look.color)) << color;
    EXPECT_THAT(scene_of(look), HasSubstr("\ncolor = \"" + look.color + "\"\n"));
  }
  // A column may be of numbers or of names.
  look.color = "energy";
  EXPECT_TRUE(has_color_map(look.color));
  EXPECT_THAT(scene_of(look), HasSubstr("\ncolor = \"energy\"\n"));
  look.map = "magma";
  EXPECT_THAT(scene_of(look), HasSubstr("\n[particles.color]\nby = \"energy\"\nmap = \"magma\"\n"));
  look.color = "Velocity Magnitude";
  EXPECT_TRUE(has_color_map(look.color));
  EXPECT_THAT(scene_of(look), HasSubstr("\nby = \"Velocity Magnitude\"\nmap = \"magma\"\n"));
}

TEST(ParticleLook, NamesOfFilesMayHaveAnyCharacters) {
  EXPECT_THAT(look_scene("a \"b\"\\c\n.xyz", {}),
              HasSubstr("file = \"a \\\"b\\\"\\\\c\\u000a.xyz\"\n"));
}

TEST(ParticleLook, TheCameraIsFitted) {
  LookOptions look;
  EXPECT_THAT(scene_of(look), HasSubstr("[camera]\nfit = true\nfov = 20\n"));
  look.view = ViewChoice{Vec3d{0, 0, -2}};
  look.up = Vec3d{0, 1, 0};
  EXPECT_THAT(scene_of(look), HasSubstr("\ndirection = [0, 0, -2]\nup = [0, 1, 0]\n"));
}

TEST(ParticleLook, TheCameraTakesItsOptions) {
  LookOptions look;
  look.view = ViewChoice{{}, FittedPose::principal};
  look.roll = 30;
  look.fov = 35.5;
  look.margin = 0.125;
  EXPECT_THAT(scene_of(look), HasSubstr("[camera]\nfit = true\npose = \"principal\"\nroll = 30\n"
                                        "fov = 35.5\nmargin = 0.125\n"));
  LookOptions flat;
  flat.ortho = true;
  EXPECT_THAT(scene_of(flat), HasSubstr("[camera]\nfit = true\ntype = \"orthographic\"\n\n"));
  flat.floor = true;
  EXPECT_THAT(scene_of(flat), HasSubstr("\npose = \"upright\"\n"));
}

TEST(ParticleLook, LooksDiffer) {
  LookOptions paper, plain, dark, quick;
  plain.look = Look::plain;
  dark.look = Look::dark;
  quick.quick = true;
  EXPECT_THAT(scene_of(paper), AllOf(HasSubstr("\"path\""), HasSubstr("\"#ffffff\"")));
  EXPECT_THAT(scene_of(plain), AllOf(HasSubstr("\"whitted\""), HasSubstr("\"#ffffff\"")));
  EXPECT_THAT(scene_of(dark), AllOf(HasSubstr("\"path\""), Not(HasSubstr("\"#ffffff\""))));
  EXPECT_THAT(scene_of(quick), AllOf(HasSubstr("\"whitted\""), HasSubstr("\nspp = 4\n")));
}

TEST(ParticleLook, AFloorIsAPlane) {
  LookOptions look;
  look.floor = true;
  const LookFloor floor{{0, 0, -1.5}, {0, 0, 1}};
  EXPECT_THAT(scene_of(look, floor), HasSubstr("[[plane]]\n"
                                               "point = [0, 0, -1.5]\n"
                                               "normal = [0, 0, 1]\n"
                                               "material = \"floor\"\n"));
}

}  // namespace
}  // namespace boule
