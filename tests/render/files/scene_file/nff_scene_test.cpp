#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/render/files/scene_file/scene_dump.h"
#include "tests/render/files/scene_file/scene_folder.h"

// NFF files that are right: the Scene is exactly what they say.

namespace boule::nff_scene {
namespace {

using test::dump;
using test::SceneFolder;

LoadedScene load(const std::string& text, PolygonPolicy polygons = PolygonPolicy::plane) {
  auto loaded = SceneFolder{}.load("scene.nff", text, {polygons});
  if (!loaded) throw std::runtime_error(format_diagnostic(loaded.error()));
  return std::move(loaded).value();
}

/// A view for scenes that are about something else.
const std::string view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 8 8\n";

/// As the SPD program "balls" writes it, size factor 0 and one ball of the next size.
const std::string balls = R"(b 0.078 0.361 0.753
v
from 2.1 1.3 1.7
at 0 0 0
up 0 0 1
angle 45
hither 0.01
resolution 512 512
l 4 3 2
l 1 -4 4
l -3 1 5
f 1 0.75 0.33 0.8 0 100000 0 1
p 4
12 12 -0.5
-12 12 -0.5
-12 -12 -0.5
12 -12 -0.5
f 1 0.9 0.7 0.5 0.5 3.0827 0 1
s 0 0 0 0.5
s 0.272166 0.272166 0.544331 0.166667
)";

Scene balls_scene() {
  const float share = static_cast<float>(1 / std::sqrt(3.0));
  Scene scene;
  scene.image = {512, 512, 1};
  scene.camera = PinholeCamera{{{2.1f, 1.3f, 1.7f}, {0, 0, 0}, {0, 0, 1}}, 45, FovAxis::x};
  scene.background = ConstantBackground{{0.078f, 0.361f, 0.753f}};
  scene.materials = {{"f@12", Phong{{1, 0.75f, 0.33f}, 0, 0.8f, 0, 100000, 0, 1}},
                     {"f@18", Phong{{1, 0.9f, 0.7f}, 0, 0.5f, 0.5f, 3.0827f, 0, 1}}};
  for (const Vec3f& position : {Vec3f{4, 3, 2}, Vec3f{1, -4, 4}, Vec3f{-3, 1, 5}}) {
    scene.lights.emplace_back(PointLight{position, gray(share), Falloff::none});
  }
  scene.spheres = {{{0, 0, 0}, 0.5f, 1}, {{0.272166f, 0.272166f, 0.544331f}, 0.166667f, 1}};
  scene.planes = {{{12, 12, -0.5f}, {0, 0, 1}, 0}};
  return scene;
}

TEST(NffScene, Balls) {
  const SceneFolder files;
  const auto loaded = files.load("balls.nff", balls);
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  EXPECT_EQ(dump(loaded.value().scene), dump(balls_scene()));
  EXPECT_EQ(loaded.value().warnings,
            std::vector<std::string>{
                files.path("balls.nff") +
                ":13: warning: a polygon becomes its infinite plane (1 in this file)"});
}

TEST(NffScene, DosLinesTabsAndCommentsChangeNothing) {
  std::string text = "\xef\xbb\xbf# made by hand\n\n  \t\n";
  for (const char c : balls)
    text += c == '\n' ? " # note\r\n" : c == ' ' ? "\t " : std::string(1, c);
  Scene expected = balls_scene();
  expected.materials[0].name = "f@15";
  expected.materials[1].name = "f@21";
  EXPECT_EQ(dump(load(text).scene), dump(expected));
}

TEST(NffScene, SkippedPolygonsLeaveNoTrace) {
  Scene expected = balls_scene();
  expected.planes.clear();
  const LoadedScene loaded = load(balls, PolygonPolicy::skip);
  EXPECT_EQ(dump(loaded.scene), dump(expected));
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(NffScene, ConesAreSkippedAsPolygonsAre) {
  const std::string cone = "c\n0 0 1 0.2\n0 0 2 0.1\n", sphere = "s 5 5 5 1\n";
  const LoadedScene loaded = load(balls + cone + sphere, PolygonPolicy::skip);
  EXPECT_EQ(dump(loaded.scene), dump(load(balls + sphere, PolygonPolicy::skip).scene));
  const auto error = [&](const std::string& text) {
    const auto broken = SceneFolder{}.load("a.nff", balls + text, {PolygonPolicy::skip});
    return broken.ok() ? "no error" : broken.error().message;
  };
  EXPECT_EQ(error("c\n0 0 1 0.2\n"), "the file ends after 1 of 2 ends of a cone");
  EXPECT_THAT(error("c\n0 0 1\n0 0 2 0.1\n"), testing::HasSubstr("the line ends here"));
}

TEST(NffScene, RefusedPolygonsAreErrors) {
  const auto loaded = SceneFolder{}.load("a.nff", balls, {PolygonPolicy::error});
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().line, 13);
  EXPECT_EQ(loaded.error().column, 1);
  EXPECT_EQ(loaded.error().key, "p");
  EXPECT_EQ(loaded.error().message, "polygons are not accepted");
}

TEST(NffScene, OneWarningForAllPolygons) {
  const std::string triangle = "p 3\n0 0 0\n1 0 0\n0 1 0\n";
  const LoadedScene loaded = load(view + triangle + triangle + triangle);
  EXPECT_EQ(loaded.scene.planes.size(), 3u);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_THAT(loaded.warnings[0], testing::HasSubstr(":7: warning: "));
  EXPECT_THAT(loaded.warnings[0], testing::HasSubstr("3 in this file"));
}

TEST(NffScene, ObjectsBeforeTheFirstFillAreWhite) {
  const Scene scene = load("s 0 0 0 1\n" + view + "f 1 0 0 1 0 0 0 1\ns 0 0 0 2\n").scene;
  Scene expected;
  expected.image = {8, 8, 1};
  expected.camera = PinholeCamera{{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}}, 45, FovAxis::x};
  expected.materials = {{"default", Phong{{1, 1, 1}, 0, 1, 0, 0, 0, 1}},
                        {"f@8", Phong{{1, 0, 0}, 0, 1, 0, 0, 0, 1}}};
  expected.spheres = {{{0, 0, 0}, 1, 0}, {{0, 0, 0}, 2, 1}};
  EXPECT_EQ(dump(scene), dump(expected));
}

TEST(NffScene, OpaqueFillsMayLeaveTheIorZero) {
  const Scene scene = load(view + "f 1 1 1 0.75 0.25 37 0 0\n").scene;
  EXPECT_EQ(std::get<Phong>(scene.materials[0].material).ior, 1.0f);
}

TEST(NffScene, LightsWithAColorKeepIt) {
  const Scene scene = load(view + "l 1 2 3 0.5 0.25 0.125\nl 4 5 6\n").scene;
  const auto& colored = std::get<PointLight>(scene.lights[0]);
  const auto& shared = std::get<PointLight>(scene.lights[1]);
  EXPECT_EQ(colored.intensity, (Color{0.5f, 0.25f, 0.125f}));
  EXPECT_EQ(shared.intensity, gray(static_cast<float>(1 / std::sqrt(2.0))));
}

TEST(NffScene, ViewMembersInAnyOrderWithoutHither) {
  const Scene scene =
      load("v\nresolution 8 8\nup 0 1 0\nangle 45\nat 0 0 0\n# note\nfrom 0 0 5").scene;
  EXPECT_EQ(dump(scene), dump(load(view).scene));
}

TEST(NffScene, PolygonNormalsFollowTheVertexOrder) {
  const auto normal = [](const std::string& polygon) {
    return load(view + polygon).scene.planes.at(0).normal;
  };
  EXPECT_EQ(normal("p 3\n0 0 0\n1 0 0\n0 1 0\n"), (Vec3f{0, 0, 1}));
  EXPECT_EQ(normal("p 3\n0 0 0\n0 1 0\n1 0 0\n"), (Vec3f{0, 0, -1}));
  // Concave at its first corner, far from the origin, and tiny.
  EXPECT_EQ(normal("p 4\n1 1 7\n0 3 7\n0 0 7\n3 0 7\n"), (Vec3f{0, 0, 1}));
  EXPECT_EQ(normal("p 3\n10000 5 0\n10001 5 0\n10000 5 1\n"), (Vec3f{0, -1, 0}));
  EXPECT_EQ(normal("p 3\n0 0 0\n0 1e-30 0\n0 0 1e-30\n"), (Vec3f{1, 0, 0}));
  // A patch's shading normals are not its plane's.
  EXPECT_EQ(normal("pp 3\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n"), (Vec3f{0, 0, 1}));
}

TEST(NffScene, NumbersAreRoundedToFloatOnce) {
  const auto x = [](const std::string& number) {
    return load(view + "s " + number + " 0 0 1e37\n").scene.spheres.at(0).center.x;
  };
  EXPECT_EQ(x("0.1"), 0.1f);
  EXPECT_EQ(x("+2.5"), 2.5f);
  EXPECT_EQ(x(".5"), 0.5f);
  EXPECT_EQ(x("-1E2"), -100.0f);
  EXPECT_EQ(x("16777217"), 16777216.0f);
  EXPECT_EQ(x("3.4028235677973362e38"), std::numeric_limits<float>::max());
  EXPECT_EQ(x("1e-40"), 1e-40f);
  EXPECT_EQ(x("1e-46"), 0.0f);
  EXPECT_EQ(x("1e-400"), 0.0f);
  EXPECT_TRUE(std::signbit(x("-1e-99999999999999999999")));
  EXPECT_EQ(x("0." + std::string(400, '0') + "1e50"), 0.0f);
  EXPECT_EQ(x("0." + std::string(400, '0') + "1e401"), 1.0f);
}

}  // namespace
}  // namespace boule::nff_scene
