// [[particles]]: what its keys make of a file's frame, and what is refused, with the place.
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/math/srgb.h"
#include "tests/render/files/scene_file/scene_folder.h"

namespace boule::toml_particles {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Water, four molecules' worth of columns: three atoms in a cell, with radii, speeds and colours.
constexpr const char* atoms =
    "3\n"
    "Lattice=\"4 0 0 0 5 0 0 0 6\" pbc=\"T T T\" Time=2.5 "
    "Properties=species:S:1:pos:R:3:radius:R:1:size:R:1:vel:R:3:red:R:1:green:R:1:blue:R:1:hex:S:"
    "1\n"
    "O 1 1 1 0.5 2 3 0 4 1 0 0 #112233\n"
    "H 2 1 1 0.25 3 0 0 1 0 1 0 #445566\n"
    "H 1 2 -1 0.125 4 0 0 0 0 0 1 #778899\n";

/// `count` frames of one atom each, whose x is the frame's number.
std::string trajectory(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "1\nProperties=species:S:1:pos:R:3:v:R:1\nC " + std::to_string(i) + " 0 0 " +
            std::to_string(10 * i) + "\n";
  }
  return text;
}

class TomlParticlesTest : public testing::Test {
 protected:
  TomlParticlesTest() {
    write("atoms.xyz", atoms);
    write("run.xyz", trajectory(5));
  }

  void write(const std::string& name, const std::string& bytes) const {
    static_cast<void>(files_.write(name, bytes));
  }
  [[nodiscard]] Result<LoadedScene> load(const std::string& text,
                                         const SceneFileOptions& options = {}) const {
    return files_.load("scene.toml", "schema = 1\n" + text, options);
  }
  /// The scene of a text, which must be right.
  [[nodiscard]] LoadedScene loaded(const std::string& text,
                                   const SceneFileOptions& options = {}) const {
    auto result = load(text, options);
    EXPECT_TRUE(result.ok()) << format_diagnostic(result.error()) << "\n" << text;
    return result.ok() ? std::move(result).value() : LoadedScene{};
  }
  /// That of one table with these keys.
  [[nodiscard]] LoadedScene with(const std::string& keys, const char* file = "atoms.xyz",
                                 const SceneFileOptions& options = {}) const {
    return loaded("[[particles]]\nfile = \"" + std::string(file) + "\"\n" + keys, options);
  }
  /// Expects an error in line 4, at the value of the first of the keys.
  void expect_refused(const std::string& keys, const std::string& key, const std::string& words,
                      const char* file = "atoms.xyz") const {
    const auto refused = load("[[particles]]\nfile = \"" + std::string(file) + "\"\n" + keys);
    ASSERT_FALSE(refused.ok()) << keys;
    const Diagnostic& error = refused.error();
    EXPECT_EQ(error.key, "particles[0]." + key) << keys << error.message;
    EXPECT_EQ(error.file, files_.path("scene.toml"));
    EXPECT_EQ(error.line, 4) << keys << error.message;
    EXPECT_EQ(error.column, static_cast<int>(keys.find('=')) + 3) << keys;
    EXPECT_THAT(error.message, HasSubstr(words)) << keys;
  }

  test::SceneFolder files_;
};

std::vector<float> radii(const LoadedScene& loaded) {
  std::vector<float> list;
  for (const Sphere& sphere : loaded.scene.spheres) list.push_back(sphere.radius);
  return list;
}

std::vector<std::string> colors(const LoadedScene& loaded) {
  std::vector<std::string> list;
  for (const Sphere& sphere : loaded.scene.spheres) {
    list.push_back(sphere.material.has_color() ? hex_text(sphere.material.color()) : "own");
  }
  return list;
}

std::vector<float> xs(const LoadedScene& loaded) {
  std::vector<float> list;
  for (const Sphere& sphere : loaded.scene.spheres) list.push_back(sphere.center.x);
  return list;
}

TEST_F(TomlParticlesTest, BecomeSpheres) {
  const LoadedScene scene = with("");
  ASSERT_EQ(scene.scene.spheres.size(), 3u);
  EXPECT_EQ(scene.scene.spheres[2].center, (Vec3f{1, 2, -1}));
  EXPECT_THAT(radii(scene), ElementsAre(0.5F, 0.25F, 0.125F));
  EXPECT_THAT(scene.data_files, ElementsAre(files_.path("atoms.xyz")));
}

TEST_F(TomlParticlesTest, HaveRadiiFromNumbersColumnsAndTables) {
  EXPECT_THAT(radii(with("radius = 0.75\n")), ElementsAre(0.75F, 0.75F, 0.75F));
  EXPECT_THAT(radii(with("radius = 2\nscale = 0.25\n")), ElementsAre(0.5F, 0.5F, 0.5F));
  EXPECT_THAT(radii(with("radius = \"size\"\n")), ElementsAre(2, 3, 4));
  const auto vdw = radii(with("radius = \"vdw\"\n")),
             bonded = radii(with("radius = \"covalent\"\n"));
  EXPECT_EQ(vdw[1], vdw[2]);
  EXPECT_EQ(bonded[1], bonded[2]);
  EXPECT_LT(bonded[0], vdw[0]);
  EXPECT_LT(bonded[1], bonded[0]);
}

TEST_F(TomlParticlesTest, HaveColorsFromTheKey) {
  EXPECT_THAT(colors(with("color = \"#102030\"\n")), ElementsAre("#102030", "#102030", "#102030"));
  EXPECT_THAT(colors(with("color = [1, 0, 0]\n")), ElementsAre("#ff0000", "#ff0000", "#ff0000"));
  EXPECT_THAT(colors(with("color = \"hex\"\n")), ElementsAre("#112233", "#445566", "#778899"));
  EXPECT_THAT(colors(with("color = \"red green blue\"\n")),
              ElementsAre("#ff0000", "#00ff00", "#0000ff"));
  for (const char* name : {"element", "species"}) {
    const auto by_species = colors(with("color = \"" + std::string(name) + "\"\n"));
    EXPECT_EQ(by_species[1], by_species[2]);
    EXPECT_NE(by_species[0], by_species[1]);
  }
}

TEST_F(TomlParticlesTest, TakeColorsFromBlankedColumnNames) {
  write("a.csv", "x,y,z,r,Two words,Three words here\n0,0,0,1,#102030,#405060\n");
  EXPECT_THAT(colors(with("color = \"Two words\"\n", "a.csv")), ElementsAre("#102030"));
  EXPECT_THAT(colors(with("color = \"Three words here\"\n", "a.csv")), ElementsAre("#405060"));
  expect_refused("color = \" \"\n", "color", "' ' is no colour");
}

TEST_F(TomlParticlesTest, HaveColorsFromAMap) {
  const ColorMap viridis, grey(NamedColorMap::grey);
  const auto codes = [](const ColorMap& map, std::array<double, 3> at) {
    return ElementsAre(hex_text(map.color(at[0])), hex_text(map.color(at[1])),
                       hex_text(map.color(at[2])));
  };
  EXPECT_THAT(colors(with("[particles.color]\nby = \"size\"\nrange = [1, 5]\n")),
              codes(viridis, {0.25, 0.5, 0.75}));
  EXPECT_THAT(colors(with("color = {by = \"size\", map = \"grey\", range = [2, 4]}\n")),
              codes(grey, {0, 0.5, 1}));
  EXPECT_THAT(colors(with("[particles.color]\nby = \"|v|\"\nrange = [0, 10]\n"
                          "map = [\"#000000\", \"#0a1420\"]\n")),
              codes(ColorMap({{0, 0, 0}, {10, 20, 32}}), {0.5, 0.1, 0}));
}

TEST_F(TomlParticlesTest, ShareTheRangeOfAnotherFrame) {
  const std::string keys = "frame = 1\n[particles.color]\nby = \"v\"\n";
  SceneFileOptions options;
  options.choices["particles[0]"].range = {0, 40};
  options.choices["particles[0]"].of_frames = "all 5 frames";
  const LoadedScene scene = with(keys, "run.xyz", options);
  EXPECT_THAT(colors(scene), ElementsAre(hex_text(ColorMap().color(0.25))));
  EXPECT_THAT(scene.particles[0].colors.scale->range, ElementsAre(0, 40));
  EXPECT_THAT(scene.notes,
              testing::Contains(HasSubstr("'v' go from 0 to 40, the lowest 1st and the "
                                          "highest 99th percentile of all 5 frames")));
  // What the file says comes first.
  EXPECT_THAT(colors(with(keys + "range = [10, 20]\n", "run.xyz", options)),
              ElementsAre(hex_text(ColorMap().color(0))));
}

TEST_F(TomlParticlesTest, KeepTheRestOfTheirMaterial) {
  const LoadedScene scene = loaded(
      "[material.a]\n[material.shiny]\ntype = \"plastic\"\n"
      "[[particles]]\nfile = \"atoms.xyz\"\nmaterial = \"shiny\"\n");
  for (const Sphere& sphere : scene.scene.spheres) EXPECT_EQ(sphere.material.index(), 1u);
  EXPECT_EQ(scene.scene.materials.size(), 2u);
}

TEST_F(TomlParticlesTest, AreSelectedWrappedAndReplicated) {
  EXPECT_THAT(radii(with("select = \"size >= 3 && x < 2\"\n")), ElementsAre(0.125F));
  const LoadedScene wrapped = with("wrap = true\n");
  EXPECT_EQ(wrapped.scene.spheres[2].center, (Vec3f{1, 2, 5}));
  const LoadedScene many = with("replicate = [2, 1, 3]\n");
  EXPECT_EQ(many.scene.spheres.size(), 18u);
  EXPECT_EQ(many.particles.at(0).particles, 3u);
  EXPECT_EQ(many.particles.at(0).spheres, 18u);
}

TEST_F(TomlParticlesTest, ComeFromTheRequestedFrame) {
  EXPECT_THAT(xs(with("", "run.xyz")), ElementsAre(4));
  EXPECT_THAT(xs(with("frame = -1\n", "run.xyz")), ElementsAre(4));
  EXPECT_THAT(xs(with("frame = 0\n", "run.xyz")), ElementsAre(0));
  EXPECT_THAT(xs(with("frame = -4\n", "run.xyz")), ElementsAre(1));
  SceneFileOptions third;
  third.frame = 3;
  EXPECT_THAT(xs(with("", "run.xyz", third)), ElementsAre(3));
  EXPECT_THAT(xs(with("frame = 1\n", "run.xyz", third)), ElementsAre(1));
  // One frame, and a file for each picture, are what they are.
  EXPECT_EQ(with("", "atoms.xyz", third).scene.spheres.size(), 3u);
  write("run.0003.xyz", trajectory(2));
  EXPECT_THAT(xs(with("", "run.####.xyz", third)), ElementsAre(1));
}

TEST_F(TomlParticlesTest, MissingFrameIsRefused) {
  expect_refused("frame = 5\n", "frame", "has no frame 5, it has 5 frames, from 0 to 4", "run.xyz");
  expect_refused("frame = -6\n", "frame", "has no frame -6, it has 5 frames", "run.xyz");
  expect_refused("frame = 1\n", "frame", "has no frame 1, it has one frame, number 0");
  SceneFileOptions far;
  far.frame = 7;
  const auto refused = load("[[particles]]\nfile = \"run.xyz\"\n", far);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().key, "particles[0].file");
  EXPECT_THAT(refused.error().message, HasSubstr("'run.xyz' has no frame 7, it has 5 frames"));
}

TEST_F(TomlParticlesTest, KeepTheirOrderAmongOtherSpheres) {
  const LoadedScene scene = loaded(
      "[[sphere]]\ncenter = [10, 0, 0]\n"
      "[[particles]]\nfile = \"run.xyz\"\nframe = 1\n"
      "[[sphere]]\ncenter = [20, 0, 0]\n"
      "[[particles]]\nfile = \"run.xyz\"\nframe = 2\n");
  EXPECT_THAT(xs(scene), ElementsAre(10, 1, 20, 2));
  EXPECT_EQ(scene.particles.at(1).table, "particles[1]");
}

TEST_F(TomlParticlesTest, MayBeInsideGroups) {
  const LoadedScene scene = loaded(
      "[[group.pair.particles]]\nfile = \"run.xyz\"\nframe = 3\nradius = 1\n"
      "[[group.pair.sphere]]\n[[instance]]\ngroup = \"pair\"\n");
  ASSERT_EQ(scene.scene.groups.size(), 1u);
  ASSERT_EQ(scene.scene.groups[0].spheres.size(), 2u);
  EXPECT_EQ(scene.scene.groups[0].spheres[0].center.x, 3);
  EXPECT_EQ(scene.particles.at(0).table, "group.pair.particles[0]");
}

TEST_F(TomlParticlesTest, AreToldOf) {
  const LoadedScene scene = with("[particles.color]\nby = \"size\"\nrange = [1, 5]\n");
  ASSERT_EQ(scene.particles.size(), 1u);
  const ParticleFacts& facts = scene.particles[0];
  EXPECT_EQ(facts.table, "particles[0]");
  EXPECT_EQ(facts.file, files_.path("atoms.xyz"));
  EXPECT_EQ(facts.format, "xyz");
  EXPECT_EQ(facts.frames, 1u);
  EXPECT_EQ(facts.frame, 0u);
  EXPECT_EQ(facts.time, 2.5);
  EXPECT_EQ(facts.particles, 3u);
  EXPECT_THAT(facts.radius_source, HasSubstr("radius"));
  ASSERT_TRUE(facts.cell);
  EXPECT_EQ(facts.cell->c, (Vec3d{0, 0, 6}));
  ASSERT_TRUE(facts.colors.scale);
  EXPECT_EQ(facts.colors.scale->by, "size");
  const LoadedScene by_species = with("color = \"element\"\n", "run.xyz");
  EXPECT_EQ(by_species.particles.at(0).frames, 5u);
  EXPECT_EQ(by_species.particles.at(0).frame, 4u);
  const auto& species = by_species.particles.at(0).colors.species;
  ASSERT_EQ(species.size(), 1u);
  EXPECT_EQ(species[0].name, "C");
  EXPECT_EQ(species[0].count, 1u);
}

TEST_F(TomlParticlesTest, HaveNotesWithTheirFile) {
  const LoadedScene scene = with("[particles.color]\nby = \"size\"\n");
  EXPECT_THAT(scene.notes, testing::Contains(testing::StartsWith("atoms.xyz: ")));
}

TEST_F(TomlParticlesTest, WithACellHaveZUp) {
  EXPECT_EQ(with("").scene.fit.up, (Vec3f{0, 0, 1}));
  EXPECT_EQ(with("", "run.xyz").scene.fit.up, std::nullopt);
  const std::string fit = "[camera]\nfit = true\n";
  EXPECT_EQ(with(fit + "direction = [1, 0, 0]\n").scene.fit.up, (Vec3f{0, 0, 1}));
  EXPECT_EQ(with(fit + "up = [0, 1, 0]\n").scene.fit.up, (Vec3f{0, 1, 0}));
  EXPECT_EQ(with(fit + "direction = [0, 0, -1]\n").scene.fit.up, std::nullopt);
  const LoadedScene placed = with("[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n");
  EXPECT_EQ(std::get<PinholeCamera>(*placed.scene.camera).pose.up, (Vec3f{0, 1, 0}));
}

TEST_F(TomlParticlesTest, TakeAGivenFormatAndColumns) {
  write("atoms.film", atoms);
  EXPECT_EQ(with("format = \"xyz\"\n", "atoms.film").scene.spheres.size(), 3u);
  write("plain.xyz", "1\n\nC 1 2 3 7\n");
  EXPECT_THAT(
      radii(with("columns = [\"species\", \"x\", \"y\", \"z\", \"radius\"]\n", "plain.xyz")),
      ElementsAre(7));
}

TEST_F(TomlParticlesTest, WrongKeysAreRefused) {
  expect_refused("radius = 0\n", "radius", "above 0, is 0");
  expect_refused("radius = -1.5\n", "radius", "above 0, is -1.5");
  expect_refused("radius = inf\n", "radius", "must be finite");
  expect_refused("radius = true\n", "radius", "expected a number, got a boolean");
  expect_refused("radius = \"\"\n", "radius", "a column");
  expect_refused("radius = \"siz\"\n", "radius", "siz");
  expect_refused("scale = 0\n", "scale", "above 0");
  expect_refused("scale = \"big\"\n", "scale", "expected a number");
  expect_refused("color = \"#12345\"\n", "color", "expected \"#rrggbb\"");
  expect_refused("color = [255, 0, 0]\n", "color", "1 is white");
  expect_refused("color = [1, 0]\n", "color", "3 numbers");
  expect_refused("color = 7\n", "color", "3 numbers");
  expect_refused("color = \"\"\n", "color", "expected \"#rrggbb\"");
  expect_refused("color = \"red green\"\n", "color", "three columns");
  expect_refused("color = \"rde\"\n", "color", "rde");
  expect_refused("frame = 1.5\n", "frame", "an integer");
  expect_refused("format = \"xyzz\"\n", "format", "did you mean 'xyz'");
  expect_refused("columns = \"x y z\"\n", "columns", "an array of strings");
  expect_refused("water = 1\n", "water", "true or false");
  expect_refused("select = \"size >\"\n", "select", "");
  expect_refused("select = 3\n", "select", "a string");
  expect_refused("wrap = \"yes\"\n", "wrap", "true or false");
  expect_refused("wrap = true\n", "wrap", "cell", "run.xyz");
  for (const std::string key : {"unwrap", "boundary"})
    expect_refused(key + " = true\n", key, "cell", "run.xyz");
  expect_refused("replicate = [2, 2]\n", "replicate", "3 integers");
  expect_refused("replicate = [1, 0, 1]\n", "replicate", "must be 1 or above, is 0");
  expect_refused("replicate = [2, 2, 2]\n", "replicate", "cell", "run.xyz");
}

TEST_F(TomlParticlesTest, UnknownOrMissingKeysAreRefused) {
  const auto unknown = load("[[particles]]\nfile = \"atoms.xyz\"\nradiu = 1\n");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().key, "particles[0].radiu");
  EXPECT_EQ(unknown.error().line, 4);
  EXPECT_THAT(unknown.error().message, HasSubstr("did you mean 'radius'"));
  const auto missing = load("[[particles]]\n");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().key, "particles[0].file");
  EXPECT_EQ(missing.error().line, 2);
  const auto material = load("[[particles]]\nfile = \"atoms.xyz\"\nmaterial = \"red\"\n");
  ASSERT_FALSE(material.ok());
  EXPECT_EQ(material.error().key, "particles[0].material");
}

TEST_F(TomlParticlesTest, WrongMapsAreRefusedInTheirTable) {
  const auto expect = [&](const std::string& key, const std::string& value, const char* words) {
    std::string keys = key == "by" ? "" : "by = \"size\"\n";
    const int line = key == "by" ? 5 : 6;
    keys += key + " = " + value + "\n";
    const auto refused = load("[[particles]]\nfile = \"atoms.xyz\"\n[particles.color]\n" + keys);
    ASSERT_FALSE(refused.ok()) << keys;
    EXPECT_EQ(refused.error().key, "particles[0].color." + key);
    EXPECT_EQ(refused.error().line, line);
    EXPECT_EQ(refused.error().column, static_cast<int>(key.size()) + 4);
    EXPECT_THAT(refused.error().message, HasSubstr(words));
  };
  expect("by", "\"siz\"", "siz");
  expect("by", "\"hex\"", "hex");
  expect("by", "\"\"", "the name of a column");
  expect("by", "3", "a string");
  expect("map", "\"virdis_r\"", "unknown 'virdis_r'");
  expect("map", "[\"#12\"]", "expected \"#rrggbb\"");
  expect("range", "[2, 1]", "below the second");
  expect("range", "[1]", "2 numbers");
  const auto missing =
      load("[[particles]]\nfile = \"atoms.xyz\"\n[particles.color]\nmap = \"magma\"\n");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().key, "particles[0].color.by");
}

TEST_F(TomlParticlesTest, FileErrorsKeepTheirPlace) {
  write("bad.xyz", "2\n\nC 0 0 0\nC 0 zero 0\n");
  const auto bad = load("[[particles]]\nfile = \"bad.xyz\"\n");
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().file, files_.path("bad.xyz"));
  EXPECT_EQ(bad.error().line, 4);
  EXPECT_EQ(bad.error().column, 5);
  const auto expect_at_name = [&](const char* name, const char* words) {
    const auto refused = load("[[particles]]\nfile = \"" + std::string(name) + "\"\n");
    ASSERT_FALSE(refused.ok()) << name;
    EXPECT_EQ(refused.error().file, files_.path("scene.toml"));
    EXPECT_EQ(refused.error().key, "particles[0].file");
    EXPECT_EQ(refused.error().line, 3);
    EXPECT_THAT(refused.error().message, HasSubstr("'" + std::string(name) + "': "));
    EXPECT_THAT(refused.error().message, HasSubstr(words));
  };
  expect_at_name("missing.xyz", "No such file");
  write("unknown.film", "what is this\n");
  expect_at_name("unknown.film", "expected one of");
}

TEST_F(TomlParticlesTest, OfALateMaterialAreRefused) {
  std::string text;
  for (int i = 0; i < 129; ++i) text += "[material.m" + std::to_string(i) + "]\n";
  const std::string table = "[[particles]]\nfile = \"atoms.xyz\"\nmaterial = ";
  EXPECT_EQ(loaded(text + table + "\"m127\"\n").scene.spheres[0].material.index(), 127u);
  const auto refused = load(text + table + "\"m128\"\n");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().key, "particles[0].material");
}

TEST_F(TomlParticlesTest, TextIsReadLikeAFile) {
  const std::string text = "schema = 1\n[[particles]]\nfile = \"run.xyz\"\n";
  const auto made = load_scene_text(text, files_.path("none.toml"));
  ASSERT_TRUE(made.ok()) << format_diagnostic(made.error());
  EXPECT_THAT(xs(made.value()), ElementsAre(4));
  const auto refused = load_scene_text(text + "frame = 9\n", files_.path("none.toml"));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().file, files_.path("none.toml"));
  EXPECT_EQ(refused.error().line, 4);
}

}  // namespace
}  // namespace boule::toml_particles
