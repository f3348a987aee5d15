#include "core/math/monotone_cubic.h"
#include "render/files/scene_file/loaded/frame_name.h"
#include "tests/render/files/scene_file/scene_dump.h"
#include "tests/render/files/scene_file/scene_folder.h"

// Series of frames: camera keys, and names with the frame's number.

namespace boule::toml_frames {
namespace {

using test::Refusal;
using test::SceneFolder;

constexpr const char* flight = R"(schema = 1
[camera]
look_at = [0, 0, 0]
up = [0, 1, 0]
[[camera.key]]
frame = 10
eye = [0.1, 0, 5]
fov = 30
[[camera.key]]
frame = 20
eye = [5, 1, 5]
[[camera.key]]
frame = 35
eye = [5, 3, -2]
fov = 60
)";

PinholeCamera camera_at(const std::string& text, std::optional<int> frame) {
  const auto loaded = SceneFolder{}.load("scene.toml", text, {PolygonPolicy::plane, frame});
  if (!loaded) throw std::runtime_error(format_diagnostic(loaded.error()));
  return std::get<PinholeCamera>(*loaded.value().scene.camera);
}

TEST(CameraKeys, AreExactAtTheirFrames) {
  EXPECT_TRUE(camera_at(flight, 10).pose.eye == (Vec3f{0.1f, 0, 5}));
  EXPECT_TRUE(camera_at(flight, 20).pose.eye == (Vec3f{5, 1, 5}));
  EXPECT_TRUE(camera_at(flight, 35).pose.eye == (Vec3f{5, 3, -2}));
  EXPECT_EQ(camera_at(flight, 10).fov, 30);
  EXPECT_EQ(camera_at(flight, 35).fov, 60);
  EXPECT_TRUE(camera_at(flight, 12).pose.look_at == Vec3f{});
}

TEST(CameraKeys, DefaultsToFirstFrameAndClampsOutside) {
  for (const std::optional<int> frame : {std::optional<int>{}, {0}, {10}}) {
    EXPECT_TRUE(camera_at(flight, frame).pose.eye == (Vec3f{0.1f, 0, 5}));
  }
  EXPECT_TRUE(camera_at(flight, 999).pose.eye == (Vec3f{5, 3, -2}));
}

TEST(CameraKeys, EachQuantityFollowsItsOwnKeys) {
  const std::vector<TimedValue> z = {{10, 5}, {20, 5}, {35, -2}}, fov = {{10, 30}, {35, 60}};
  const std::vector<TimedValue> x = {{10, static_cast<double>(0.1f)}, {20, 5}, {35, 5}};
  for (int frame = 8; frame < 40; ++frame) {
    const PinholeCamera camera = camera_at(flight, frame);
    EXPECT_EQ(camera.pose.eye.x, static_cast<float>(monotone_cubic(x, frame)));
    EXPECT_EQ(camera.pose.eye.z, static_cast<float>(monotone_cubic(z, frame)));
    EXPECT_EQ(camera.fov, static_cast<float>(monotone_cubic(fov, frame)));
  }
}

/// The camera of `keys` at each frame from 0 to 30, keys at 5, 10 and 25.
template <class Kind>
std::vector<Kind> cameras(const std::string& keys) {
  const SceneFolder files;
  static_cast<void>(files.write("one.lens", "50 5 1.5 20\n-50 2 1 20\n0 0 1 8\n"));
  std::vector<Kind> all;
  for (int frame = 0; frame <= 30; ++frame) {
    const auto loaded =
        files.load("scene.toml", "schema = 1\n[camera]\n" + keys, {PolygonPolicy::plane, frame});
    if (!loaded) throw std::runtime_error(format_diagnostic(loaded.error()));
    all.push_back(std::get<Kind>(*loaded.value().scene.camera));
  }
  return all;
}

/// A quantity with these values at the keys.
class Course {
 public:
  Course(float a, float b, float c) : values_{{5, a}, {10, b}, {25, c}} {}
  [[nodiscard]] float at(std::size_t frame) const {
    return static_cast<float>(monotone_cubic(values_, static_cast<double>(frame)));
  }

 private:
  std::vector<TimedValue> values_;
};

TEST(CameraKeys, MoveAThinLensAndItsFocus) {
  const auto all = cameras<ThinLensCamera>(R"(type = "thin_lens"
up = [0, 1, 0.5]
fov_axis = "max"
key = [
  {frame = 5, eye = [0, 1, 9], look_at = [0, 0, 0], fov = 40, aperture = 0.25, focus = 9},
  {frame = 10, eye = [2, 1, 9], look_at = [0, 1, 0], fov = 50, aperture = 0, focus = 3},
  {frame = 25, eye = [3, 1, 4], look_at = [0, 1, -1], fov = 30, aperture = 0.5, focus = 4},
])");
  const Course x{0, 2, 3}, z{9, 9, 4}, y{0, 1, 1}, far{0, 0, -1}, fov{40, 50, 30};
  const Course aperture{0.25f, 0, 0.5f}, focus{9, 3, 4};
  for (std::size_t frame = 0; frame < all.size(); ++frame) {
    const ThinLensCamera& camera = all[frame];
    EXPECT_EQ(camera.pose.eye, (Vec3f{x.at(frame), 1, z.at(frame)})) << frame;
    EXPECT_EQ(camera.pose.look_at, (Vec3f{0, y.at(frame), far.at(frame)})) << frame;
    EXPECT_EQ(camera.fov, fov.at(frame));
    EXPECT_EQ(camera.aperture, aperture.at(frame));
    EXPECT_EQ(camera.focus, focus.at(frame));
    EXPECT_EQ(camera.pose.up, (Vec3f{0, 1, 0.5f}));
    EXPECT_EQ(camera.fov_axis, FovAxis::max);
    if (frame == 0) continue;
    // Smooth: no step beyond what a curve through these keys may take in one frame.
    EXPECT_LT(std::fabs(camera.fov - all[frame - 1].fov), 4) << frame;
    EXPECT_LT(std::fabs(*camera.focus - *all[frame - 1].focus), 2) << frame;
    EXPECT_LT(std::fabs(camera.pose.eye.x - all[frame - 1].pose.eye.x), 0.7f) << frame;
  }
}

TEST(CameraKeys, WhatIsNotKeyedStays) {
  const auto all = cameras<ThinLensCamera>(R"(type = "thin_lens"
eye = [1, 2, 9]
look_at = [0, 0, 0]
f_number = 2
focal_length = 0.5
focus = [1, 2, 0]
key = [{frame = 5, fov = 20}, {frame = 10, fov = 30}, {frame = 25, fov = 30}])");
  for (std::size_t frame = 0; frame < all.size(); ++frame) {
    ThinLensCamera expected = all[0];
    expected.fov = Course(20, 30, 30).at(frame);
    EXPECT_EQ(all[frame].pose.eye, (Vec3f{1, 2, 9}));
    EXPECT_EQ(all[frame].pose.look_at, Vec3f{});
    EXPECT_EQ(all[frame].aperture, 0.125f);
    EXPECT_EQ(all[frame].focus, expected.focus);
    EXPECT_EQ(all[frame].fov, expected.fov) << frame;
  }
}

TEST(CameraKeys, TurnAFisheye) {
  const auto all = cameras<FisheyeCamera>(R"(type = "fisheye"
eye = [0, 1, 0]
fov_axis = "y"
key = [
  {frame = 5, look_at = [0, 1, -1], fov = 180},
  {frame = 10, look_at = [1, 1, -1]},
  {frame = 25, look_at = [1, 1, 1], fov = 360},
])");
  const std::vector<TimedValue> fov = {{5, 180}, {25, 360}};
  for (std::size_t frame = 0; frame < all.size(); ++frame) {
    EXPECT_EQ(all[frame].pose.eye, (Vec3f{0, 1, 0}));
    EXPECT_EQ(all[frame].pose.look_at,
              (Vec3f{Course(0, 1, 1).at(frame), 1, Course(-1, -1, 1).at(frame)}));
    EXPECT_EQ(all[frame].fov, static_cast<float>(monotone_cubic(fov, static_cast<double>(frame))));
    EXPECT_EQ(all[frame].fov_axis, FovAxis::y);
  }
}

TEST(CameraKeys, FocusALens) {
  const auto all = cameras<LensCamera>(R"(type = "lens"
eye = [0, 0, 1]
look_at = [0, 0, 0]
file = "one.lens"
f_number = 16
key = [{frame = 5, focus = 1}, {frame = 10, focus = 2}, {frame = 25, focus = 3}])");
  for (std::size_t frame = 0; frame < all.size(); ++frame) {
    EXPECT_EQ(all[frame].focus, Course(1, 2, 3).at(frame)) << frame;
    EXPECT_EQ(all[frame].surfaces[2].aperture, all[0].surfaces[2].aperture);
    EXPECT_EQ(all[frame].surfaces[0].aperture, 20);
  }
}

TEST(CameraKeys, TooNearLaterFocusIsRefused) {
  const SceneFolder files;
  static_cast<void>(files.write("one.lens", "50 5 1.5 20\n-50 2 1 20\n0 0 1 8\n"));
  const auto loaded = files.load("scene.toml", R"(schema = 1
[camera]
type = "lens"
eye = [0, 0, 1]
look_at = [0, 0, 0]
file = "one.lens"
[[camera.key]]
frame = 5
focus = 1
[[camera.key]]
frame = 8
focus = 0.01
)");
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().line, 12);
  EXPECT_EQ(loaded.error().column, 9);
  EXPECT_EQ(loaded.error().key, "camera.focus");
  EXPECT_THAT(loaded.error().message, testing::HasSubstr("in frame 8: is nearer than the lens"));
}

TEST(FrameName, HasTheNumberWithZerosInFront) {
  EXPECT_EQ(frame_name("ball.####.npy", 7), "ball.0007.npy");
  EXPECT_EQ(frame_name("#/##-###", 42), "42/42-042");
  EXPECT_EQ(frame_name("##", 12345), "12345");
  EXPECT_EQ(frame_name("plain.npy", 3), "plain.npy");
  EXPECT_EQ(frame_name("", 3), "");
}

TEST(FrameName, DataFilesAreThoseOfTheFrame) {
  const SceneFolder files;
  const std::string view = "[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n";
  for (const std::string& table :
       {std::string("[[spheres]]\n"), std::string("[background]\ntype = \"environment\"\n"),
        view + "[camera.distortion]\n", view + "type = \"lens\"\n"}) {
    const std::string text = "schema = 1\n" + table + "file = \"part.##.dat\"\n";
    const auto load = [&](std::optional<int> frame) {
      return files.load("scene.toml", text, {PolygonPolicy::plane, frame});
    };
    EXPECT_THAT(load(5).error().message, testing::HasSubstr("'part.05.dat'"));
    EXPECT_THAT(load({}).error().message, testing::HasSubstr("'part.##.dat'"));
  }
}

/// Every key is looked at, whichever frame is read, and in a time that does not grow with its
/// square.
TEST(CameraKeys, AreCheckedAllHoweverManyThereAre) {
  std::string text = "schema = 1\n[camera]\nlook_at = [0, 0, 0]\n";
  for (int frame = 0; frame < 50000; ++frame)
    text += "[[camera.key]]\nframe = " + std::to_string(frame) + "\neye = [0, 0, 1]\n";
  EXPECT_TRUE(SceneFolder{}.load("scene.toml", text).ok());
  const auto bad = SceneFolder{}.load("scene.toml", text + "fov = 0\n");
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().line, 150004);
}

TEST(CameraKeys, OfAFisheyeMayOpenItFurther) {
  const std::string text =
      "schema = 1\n[camera]\ntype = \"fisheye\"\nlook_at = [0, 0, 0]\n"
      "[[camera.key]]\nframe = 0\neye = [0, 0, 1]\nfov = 20\n[[camera.key]]\nframe = 9\nfov = "
      "360\n";
  EXPECT_TRUE(SceneFolder{}.load("scene.toml", text).ok());
}

class CameraKeyErrors : public testing::TestWithParam<Refusal> {};

TEST_P(CameraKeyErrors, AreRefusedWithPlaceAndKey) {
  test::expect_refused(GetParam(), "scene.toml");
}

std::string key(const std::string& text) {
  return "schema = 1\n[camera]\nlook_at = [0, 0, 0]\n[[camera.key]]\n" + text;
}

const Refusal wrong[] = {
    {"NoFrame", key("eye = [0, 0, 1]\n"), 4, 1, "camera.key[0].frame", "missing key 'frame'"},
    {"FrameNegative", key("frame = -1\neye = [0, 0, 1]\n"), 5, 9, "camera.key[0].frame",
     "0 or above"},
    {"FrameFraction", key("frame = 1.5\neye = [0, 0, 1]\n"), 5, 9, "camera.key[0].frame",
     "an integer"},
    {"FrameTwice", key("frame = 1\neye = [0, 0, 1]\n[[camera.key]]\nframe = 1\nfov = 3\n"), 8, 9,
     "camera.key[1].frame", "must be above 1"},
    {"FrameBack", key("frame = 9\neye = [0, 0, 1]\n[[camera.key]]\nframe = 4\nfov = 3\n"), 8, 9,
     "camera.key[1].frame", "must be above 9"},
    {"SecondNoFrame", key("frame = 0\neye = [0, 0, 1]\n[[camera.key]]\nfov = 3\n"), 7, 1,
     "camera.key[1].frame", "missing key 'frame'"},
    {"LaterFov",
     key("frame = 1\neye = [0, 0, 1]\nfov = 20\n[[camera.key]]\nframe = 7\nfov = 180\n"), 10, 7,
     "camera.fov", "in frame 7: must be above 0 and below 180"},
    {"LaterEye", key("frame = 1\neye = [0, 0, 1]\n[[camera.key]]\nframe = 4\neye = [0, nan, 1]\n"),
     9, 7, "camera.eye", "in frame 4: must be finite"},
    {"LaterEyeIsLookAt",
     key("frame = 1\neye = [0, 0, 1]\n[[camera.key]]\nframe = 4\neye = [0, 0, 0]\n"), 3, 11,
     "camera.look_at", "in frame 4: must differ from eye"},
    {"LaterUp", key("frame = 1\neye = [0, 0, 1]\n[[camera.key]]\nframe = 4\neye = [0, 9, 0]\n"), 2,
     1, "camera.up", "in frame 4: must not be within 1e-6 rad"},
    {"LaterFocus",
     "schema = 1\n[camera]\ntype = \"thin_lens\"\naperture = 1\nlook_at = [0, 0, 0]\n"
     "focus = [0, 0, 2]\n[[camera.key]]\nframe = 0\neye = [0, 0, 5]\n"
     "[[camera.key]]\nframe = 4\neye = [0, 0, 1]\n",
     6, 9, "camera.focus", "in frame 4: must lie in front"},
    {"KeysSlip", "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n[[camera.keys]]\n", 5,
     10, "camera.keys", "unknown key 'keys'; did you mean 'key'?"},
    {"Nothing", key("frame = 1\n"), 4, 1, "camera.key[0].eye",
     "'eye', 'look_at', 'fov', 'aperture' or 'focus'"},
    {"UnknownKey", key("frame = 1\neyes = [0, 0, 1]\n"), 6, 1, "camera.key[0].eyes",
     "did you mean 'eye'?"},
    {"EyeTwo", key("frame = 1\neye = [0, 0]\n"), 6, 7, "camera.key[0].eye", "got 2"},
    {"FovType", key("frame = 1\nfov = \"a\"\n"), 6, 7, "camera.key[0].fov", "a number"},
    {"ApertureType", key("frame = 1\naperture = \"a\"\n"), 6, 12, "camera.key[0].aperture",
     "a number"},
    {"FocusPoint", key("frame = 1\nfocus = [0, 0, 1]\n"), 6, 9, "camera.key[0].focus",
     "expected a number, got an array"},
    {"ApertureNegative",
     "schema = 1\n[camera]\ntype = \"thin_lens\"\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\n"
     "[[camera.key]]\nframe = 3\naperture = -1\n",
     8, 12, "camera.aperture", "0 or above"},
    {"LaterAperture",
     "schema = 1\n[camera]\ntype = \"thin_lens\"\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\n"
     "[[camera.key]]\nframe = 3\naperture = 1\n[[camera.key]]\nframe = 4\naperture = -1\n",
     11, 12, "camera.aperture", "in frame 4: must be finite and 0 or above"},
    {"ApertureOfAPinhole", key("frame = 1\neye = [0, 0, 1]\naperture = 1\n"), 7, 12,
     "camera.aperture", "unknown key"},
    {"InBoth", key("frame = 1\nlook_at = [0, 0, 1]\n"), 3, 11, "camera.look_at",
     "stands in [[camera.key]] too"},
    {"NoList", "schema = 1\n[camera]\nkey = 4\n", 3, 7, "camera.key", "[[camera.key]]"},
    {"Empty", "schema = 1\n[camera]\nkey = []\n", 3, 7, "camera.key", "at least one"},
    {"NoTable", "schema = 1\n[camera]\nkey = [{frame = 1, fov = 3}, 4]\n", 3, 30, "camera.key[1]",
     "got an integer"},
    {"NoEye", key("frame = 1\nfov = 20\n"), 2, 1, "camera.eye", "missing key 'eye'"},
    {"FovTooLarge", key("frame = 1\neye = [0, 0, 1]\nfov = 190\n"), 7, 7, "camera.fov",
     "below 180"},
    {"EyeIsLookAt", key("frame = 1\neye = [0, 0, 0]\n"), 3, 11, "camera.look_at", "differ"},
    {"NotOfThisCamera",
     "schema = 1\n[camera]\ntype = \"orthographic\"\neye = [0, 0, 1]\nlook_at = [0, 0, 0]\n"
     "[[camera.key]]\nframe = 3\nfov = 20\n",
     8, 7, "camera.fov", "unknown key 'fov'"},
};
INSTANTIATE_TEST_SUITE_P(Wrong, CameraKeyErrors, testing::ValuesIn(wrong), test::refusal_name);

}  // namespace
}  // namespace boule::toml_frames
