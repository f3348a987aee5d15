// The key `origin`: what it is subtracted from, that this comes before rounding, and what "auto"
// chooses.
#include <cstdio>
#include <string>

#include "render/renderer/scene_hash.h"
#include "tests/render/files/scene_file/scene_folder.h"
#include "tests/render/npy_files.h"

namespace boule {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Writes points that lie where a scene around 0 has them, moved by an exact vector.
class Points {
 public:
  explicit Points(const Vec3d& moved = {}) : moved_(moved) {}

  [[nodiscard]] std::string at(double x, double y, double z) const {
    return "[" + text(x + moved_.x) + ", " + text(y + moved_.y) + ", " + text(z + moved_.z) + "]";
  }
  /// The key that takes the motion back.
  [[nodiscard]] std::string origin() const { return "origin = " + at(0, 0, 0) + "\n"; }
  /// A row of an XYZ file.
  [[nodiscard]] std::string atom(const char* element, double x, double y, double z) const {
    return std::string(element) + " " + text(x + moved_.x) + " " + text(y + moved_.y) + " " +
           text(z + moved_.z) + "\n";
  }

 private:
  static std::string text(double x) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.17g", x);
    return digits;
  }

  Vec3d moved_;
};

/// So far away that floats are 1/16 to 1/4 apart.
const Points near_zero, far_away({1000000, -2000000, 500000});

Result<LoadedScene> load(const test::SceneFolder& files, const std::string& text,
                         const SceneFileOptions& options = {}) {
  return files.load("scene.toml", "schema = 1\n" + text, options);
}

/// The scene of a text, which must be right.
LoadedScene loaded(const test::SceneFolder& files, const std::string& text,
                   const SceneFileOptions& options = {}) {
  auto result = load(files, text, options);
  EXPECT_TRUE(result.ok()) << format_diagnostic(result.error());
  return result.ok() ? std::move(result).value() : LoadedScene{};
}

/// Compares the scene far away, with its origin, and the one near 0, bit for bit.
template <class Text>
void expect_same(const Text& text, const SceneFileOptions& options = {}) {
  const test::SceneFolder files;
  const LoadedScene far = loaded(files, far_away.origin() + text(far_away), options);
  const LoadedScene near = loaded(files, text(near_zero), options);
  EXPECT_EQ(scene_hash(far.scene), scene_hash(near.scene)) << text(far_away);
  EXPECT_EQ(far.origin, (Vec3d{1000000, -2000000, 500000}));
  // Without it the points are rounded, so the test compares something.
  const LoadedScene rounded = loaded(files, "origin = [0, 0, 0]\n" + text(far_away), options);
  EXPECT_NE(scene_hash(rounded.scene), scene_hash(near.scene));
}

TEST(TomlOrigin, IsSubtractedFromPointsOfObjects) {
  expect_same([](const Points& p) {
    return "[[sphere]]\ncenter = " + p.at(0.015625, 1.5, -2.25) +
           "\n[[sphere]]\ncenter = " + p.at(0, 0, 0) +
           "\n[[plane]]\npoint = " + p.at(0.5, -1.03125, 0) + "\n";
  });
}

TEST(TomlOrigin, IsSubtractedFromLightsAndCameras) {
  expect_same([](const Points& p) {
    return "[[sphere]]\ncenter = " + p.at(0, 0, 0) +
           "\n[[light]]\nposition = " + p.at(3, 4.125, 5) +
           "\n[[light]]\ntype = \"sphere\"\ncenter = " + p.at(-3, 4, 5.03125) +
           "\n[camera]\neye = " + p.at(0, 0.0625, 5) + "\nlook_at = " + p.at(0, 0, 0.03125) + "\n";
  });
}

TEST(TomlOrigin, IsSubtractedFromThePointInFocus) {
  expect_same([](const Points& p) {
    return "[[sphere]]\ncenter = " + p.at(0, 0, 0) +
           "\n[camera]\ntype = \"thin_lens\"\neye = " + p.at(0, 0, 5) +
           "\nlook_at = " + p.at(0, 0, 0) + "\naperture = 0.1\nfocus = " + p.at(0, 0, 1.03125) +
           "\n";
  });
}

TEST(TomlOrigin, IsSubtractedFromKeysOfTheCamera) {
  SceneFileOptions options;
  options.frame = 3;
  expect_same(
      [](const Points& p) {
        std::string text = "[[sphere]]\ncenter = " + p.at(0, 0, 0) + "\n[camera]\n";
        text += "[[camera.key]]\nframe = 0\neye = " + p.at(0, 0, 5) +
                "\nlook_at = " + p.at(0, 0.03125, 0) + "\n";
        return text + "[[camera.key]]\nframe = 6\neye = " + p.at(1, 0, 6) + "\n";
      },
      options);
}

TEST(TomlOrigin, IsSubtractedFromInstancesNotInGroups) {
  expect_same([](const Points& p) {
    return "[[group.ball.sphere]]\ncenter = [0.25, 0, 0]\n"
           "[[group.pair.instance]]\ngroup = \"ball\"\ntranslate = [0, 2.5, 0]\n"
           "[[instance]]\ngroup = \"pair\"\nscale = 0.5\nrotate = [0, 90, 0]\ntranslate = " +
           p.at(0.03125, 1, 2) + "\n";
  });
}

TEST(TomlOrigin, LeavesDirectionsAndLightsOfTheCamera) {
  const test::SceneFolder files;
  const Scene scene =
      loaded(
          files,
          far_away.origin() +
              "[[sphere]]\ncenter = [1000000, -2000000, 500000]\n"
              "[[plane]]\npoint = [1000000, -2000001, 500000]\nnormal = [0, 2, 1]\n"
              "[[light]]\ntype = \"directional\"\ndirection = [1, -1, 0]\n"
              "[[light]]\nrelative_to = \"camera\"\nposition = [1, 2, 3]\n"
              "[camera]\neye = [1000000, -2000000, 500005]\nlook_at = [1000000, -2000000, 500000]\n"
              "up = [0, 1, 0.5]\n")
          .scene;
  EXPECT_EQ(scene.planes[0].normal, (Vec3f{0, 2, 1}));
  EXPECT_EQ(scene.planes[0].point, (Vec3f{0, -1, 0}));
  EXPECT_EQ(std::get<DirectionalLight>(scene.lights[0]).direction, (Vec3f{1, -1, 0}));
  EXPECT_EQ(std::get<PointLight>(scene.lights[1]).position, (Vec3f{1, 2, 3}));
  EXPECT_EQ(std::get<PinholeCamera>(*scene.camera).pose.up, (Vec3f{0, 1, 0.5F}));
}

TEST(TomlOrigin, MovesPointsThatHaveTheirDefault) {
  const test::SceneFolder files;
  const Scene scene = loaded(files, "origin = [1, 2, 3]\n[[sphere]]\n[[plane]]\n").scene;
  EXPECT_EQ(scene.spheres[0].center, (Vec3f{-1, -2, -3}));
  EXPECT_EQ(scene.planes[0].point, (Vec3f{-1, -2, -3}));
}

TEST(TomlOrigin, IsSubtractedFromFileSpheresInDouble) {
  const test::SceneFolder files;
  for (const bool has_radii : {true, false}) {
    std::string rows;
    for (const double x : {1000000.015625, -2000000.5, 500000.25}) test::append_bytes(rows, x);
    if (has_radii) test::append_bytes(rows, 0.75);
    const char* const shape = has_radii ? "(1, 4)" : "(1, 3)";
    static_cast<void>(files.write("one.npy", test::npy_file(test::npy_dict("'<f8'", shape), rows)));
    const Scene scene = loaded(files, far_away.origin() + "[[spheres]]\nfile = \"one.npy\"\n" +
                                          (has_radii ? "" : "radius = 0.75\n"))
                            .scene;
    ASSERT_EQ(scene.spheres.size(), 1u);
    EXPECT_EQ(scene.spheres[0].center, (Vec3f{0.015625F, -0.5F, 0.25F}));
    EXPECT_EQ(scene.spheres[0].radius, 0.75F);
  }
}

TEST(TomlOrigin, MayMakeAPointTooLarge) {
  const test::SceneFolder files;
  const auto refused = load(files, "origin = [3e38, 0, 0]\n[[sphere]]\ncenter = [-3e38, 0, 0]\n");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().key, "sphere[0].center");
  EXPECT_EQ(refused.error().line, 4);
  EXPECT_EQ(refused.error().column, 10);
}

/// Two atoms and a third one a little further.
std::string three_atoms(const Points& p) {
  return "3\n\n" + p.atom("C", 0, 0, 0) + p.atom("C", 1.5, 0, 0) + p.atom("O", 2, 1.25, 0.125);
}

TEST(TomlOrigin, AutoMovesScenesFarForTheirSize) {
  const test::SceneFolder files;
  static_cast<void>(files.write("far.xyz", three_atoms(far_away)));
  static_cast<void>(files.write("near.xyz", three_atoms(near_zero)));
  const std::string camera = "[camera]\nlook_at = " + far_away.at(1, 0, 0) +
                             "\neye = " + far_away.at(1, 0, 9.03125) + "\n";
  const LoadedScene far =
      loaded(files, "[[particles]]\nfile = \"far.xyz\"\n" + camera);  // auto is the default
  ASSERT_EQ(far.scene.spheres.size(), 3u);
  EXPECT_EQ(far.origin, (Vec3d{1000000, -2000000, 500000}));
  EXPECT_THAT(far.notes, ElementsAre(HasSubstr("radii"), HasSubstr("counted from [1000000, ")));
  // What it was before it was moved by a round number.
  const LoadedScene near = loaded(
      files,
      "[[particles]]\nfile = \"near.xyz\"\n[camera]\nlook_at = [1, 0, 0]\neye = [1, 0, 9.03125]\n");
  EXPECT_EQ(near.origin, Vec3d{});
  EXPECT_EQ(scene_hash(far.scene), scene_hash(near.scene));
  EXPECT_THAT(near.notes, ElementsAre(HasSubstr("radii")));
}

TEST(TomlOrigin, AutoLeavesWhatRoundingLeaves) {
  const test::SceneFolder files;
  static_cast<void>(files.write("near.xyz", three_atoms(Points({100, 50, -20}))));
  for (const char* key : {"", "origin = \"auto\"\n"}) {
    const LoadedScene near =
        loaded(files, std::string(key) + "[[particles]]\nfile = \"near.xyz\"\n");
    EXPECT_EQ(near.origin, Vec3d{});
    EXPECT_EQ(near.scene.spheres[0].center, (Vec3f{100, 50, -20}));
    EXPECT_THAT(near.notes, ElementsAre(HasSubstr("radii")));
  }
  // As large as it is far away: no point is better than another.
  static_cast<void>(files.write("wide.xyz", "2\n\nC -1e6 0 0\nC 1e6 0 0\n"));
  EXPECT_EQ(loaded(files, "[[particles]]\nfile = \"wide.xyz\"\n").origin, Vec3d{});
}

TEST(TomlOrigin, AutoIsForAllSpheres) {
  const test::SceneFolder files;
  const LoadedScene scene =
      loaded(files, "origin = \"auto\"\n[[sphere]]\ncenter = [1000000, 0, 0]\nradius = 1e-3\n");
  EXPECT_EQ(scene.origin, (Vec3d{1000000, 0, 0}));
  EXPECT_EQ(scene.scene.spheres[0].center, Vec3f{});
}

/// A group has coordinates of its own, which may be far from its own 0.
TEST(TomlOrigin, AutoIsForGroupsByThemselves) {
  const test::SceneFolder files;
  const LoadedScene scene =
      loaded(files,
             "[[group.ball.sphere]]\ncenter = [1000000.0625, 0, 0]\n"
             "[[instance]]\ngroup = \"ball\"\nrotate = [0, 0, 90]\nscale = 0.5\n"
             "translate = [0.25, -500000, 0.5]\n");
  EXPECT_EQ(scene.origin, Vec3d{});
  EXPECT_EQ(scene.origin_of(0), (Vec3d{1000000, 0, 0}));
  EXPECT_EQ(scene.scene.groups[0].spheres[0].center, (Vec3f{0.0625F, 0, 0}));
  EXPECT_EQ(scene.scene.instances[0].translate, (Vec3f{0.25F, 0, 0.5F}));
  EXPECT_EQ(shown_origin(scene, scene.scene.instances[0], scene.origin), (Vec3d{0, -500000, 0}));
}

TEST(TomlOrigin, AutoTakesAShortNearPoint) {
  const test::SceneFolder files;
  const auto origin = [&](const std::string& radius) {
    static_cast<void>(files.write("cell.xyz",
                                  "1\nLattice=\"8 0 0 0 8 0 0 0 8\" Origin=\"1000120 0 0\" "
                                  "Properties=species:S:1:pos:R:3\nC 1000121 1 1\n"));
    return loaded(files, "[[particles]]\nfile = \"cell.xyz\"\nradius = " + radius + "\n").origin;
  };
  EXPECT_EQ(origin("1.7"), (Vec3d{1000000, 0, 0}));
  EXPECT_EQ(origin("0.3"), (Vec3d{1000121, 1, 1}));  // the only atom
  EXPECT_EQ(origin("0.003"), (Vec3d{1000121, 1, 1}));
}

/// Too far apart for their radii: a point among them makes the rounding less, but not unseen.
TEST(TomlOrigin, AutoTakesAPointInWideScenes) {
  const test::SceneFolder files;
  const auto origin = [&](const std::string& atoms) {
    static_cast<void>(files.write("wide.xyz", "2\n\n" + atoms));
    return loaded(files, "[[particles]]\nfile = \"wide.xyz\"\nradius = 0.01\n").origin;
  };
  EXPECT_EQ(origin("C 1e6 0 0\nC 1.001e6 0 0\n"), (Vec3d{1000000, 0, 0}));
  EXPECT_EQ(origin("C 1000300.5 0 0\nC 1001300.5 0 0\n"), (Vec3d{1000800, 0, 0}));
}

class WrongOrigins : public testing::TestWithParam<test::Refusal> {};

TEST_P(WrongOrigins, AreRefused) { test::expect_refused(GetParam(), "scene.toml"); }

INSTANTIATE_TEST_SUITE_P(
    TomlOrigin, WrongOrigins,
    testing::Values(
        test::Refusal{"Text", "schema = 1\norigin = \"middle\"\n", 2, 10, "origin",
                      "expected \"auto\" or a point"},
        test::Refusal{"Pair", "schema = 1\norigin = [1, 2]\n", 2, 10, "origin", "3 numbers"},
        test::Refusal{"Number", "schema = 1\norigin = 1\n", 2, 10, "origin", "3 numbers"},
        test::Refusal{"Infinite", "schema = 1\norigin = [1, inf, 2]\n", 2, 10, "origin", "finite"},
        test::Refusal{"NoNumber", "schema = 1\norigin = [1, nan, 2]\n", 2, 10, "origin", "finite"}),
    test::refusal_name);

TEST(OriginOfASeries, IsTakenWhereTheSceneAllows) {
  const test::SceneFolder files;
  const std::string sphere = "[[sphere]]\ncenter = [5, 0, 0]\n";
  SceneFileOptions series;
  series.origin = Vec3d{1, 2, 3};
  for (const char* key : {"", "origin = \"auto\"\n"}) {
    const LoadedScene scene = loaded(files, key + sphere, series);
    EXPECT_EQ(scene.origin, (Vec3d{1, 2, 3})) << key;
    EXPECT_EQ(scene.scene.spheres.at(0).center, (Vec3f{4, -2, -3})) << key;
  }
  EXPECT_EQ(loaded(files, "origin = [7, 0, 0]\n" + sphere, series).origin, (Vec3d{7, 0, 0}));
}

}  // namespace
}  // namespace boule
