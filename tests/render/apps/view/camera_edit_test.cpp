// Cameras that clients change, and their texts.
#include "render/apps/view/messages/camera_edit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/geometry.h"
#include "render/files/scene_file/scene_file.h"
#include "tests/support/test_scenes.h"

namespace boule::view {
namespace {

const Vec3d nowhere{};

Camera good(const Result<Camera>& camera) {
  if (camera) return camera.value();
  ADD_FAILURE() << format_diagnostic(camera.error());
  return {};
}

/// An edit of these keys.
CameraEdit change(std::map<std::string, CameraValue, std::less<>> values) {
  return {.type = {}, .values = std::move(values)};
}

TEST(CameraEdit, ChangesWhatItNames) {
  const Camera before = test::pinhole({1, 2, 3}, {0, 0, 0}, 40);
  const CameraEdit edit = change({{"eye", Vec3d{5, 6, 7}}, {"fov_axis", "max"}});
  const auto after = std::get<PinholeCamera>(good(edited(before, edit, nowhere)));
  EXPECT_EQ(after.pose.eye.y, 6);
  EXPECT_EQ(after.pose.look_at, Vec3f{});
  EXPECT_EQ(after.fov, 40);
  EXPECT_EQ(after.fov_axis, FovAxis::max);
}

TEST(CameraEdit, NullTakesAFocusAway) {
  const ThinLensCamera before{.focus = 3};
  const auto focus_after = [&](const CameraValue& value) {
    return std::get<ThinLensCamera>(good(edited(before, change({{"focus", value}}), nowhere)))
        .focus;
  };
  EXPECT_EQ(focus_after({}), std::nullopt);
  EXPECT_EQ(focus_after(2.5), 2.5F);
  EXPECT_TRUE(edited(PinholeCamera{}, change({{"focus", {}}}), nowhere));
}

TEST(CameraEdit, SubtractsTheOriginFromPointsOnly) {
  const CameraEdit edit = change({{"eye", Vec3d{1e9 + 2, 0, 5}}, {"up", Vec3d{1, 2, 0}}});
  const Camera before = test::pinhole({1, 2, 3}, {0, 0, 0}, 40);
  const auto after = std::get<PinholeCamera>(good(edited(before, edit, Vec3d{1e9, 0, 0})));
  EXPECT_EQ(after.pose.eye.x, 2);
  EXPECT_EQ(after.pose.up.x, 1);
}

TEST(CameraEdit, RefusesWhatACameraLacks) {
  const auto refused_key = [](const Camera& camera, const CameraEdit& edit) {
    return edited(camera, edit, nowhere).error().key;
  };
  EXPECT_EQ(refused_key(PinholeCamera{}, change({{"height", 2.0}})), "camera.height");
  EXPECT_EQ(refused_key(OrthographicCamera{}, change({{"fov", 20.0}})), "camera.fov");
  EXPECT_EQ(refused_key(LensCamera{}, change({{"scale", 2.0}})), "camera.scale");
  EXPECT_EQ(refused_key(PinholeCamera{}, change({{"fov", 180.0}})), "camera.fov");
  EXPECT_EQ(refused_key(PinholeCamera{}, change({{"fov", "wide"}})), "camera.fov");
  EXPECT_EQ(refused_key(PinholeCamera{}, change({{"fov_axis", "z"}})), "camera.fov_axis");
  EXPECT_EQ(refused_key(PinholeCamera{}, change({{"look_at", Vec3d{}}})), "camera.look_at");
  EXPECT_EQ(refused_key(PinholeCamera{}, {.type = "periscope"}), "camera.type");
  EXPECT_EQ(refused_key(PinholeCamera{}, {.type = "lens"}), "camera.type");
  EXPECT_EQ(refused_key(LensCamera{}, {.type = "pinhole"}), "camera.type");
  EXPECT_FALSE(edited(PinholeCamera{}, change({{"eye", Vec3d{1e200, 0, 0}}}), nowhere));
}

TEST(CameraEdit, AnotherTypeShowsAsMuch) {
  const PinholeCamera pinhole{{{0, 0, 10}, {0, 0, 0}, {0, 1, 0}}, 40, FovAxis::y};
  CameraEdit edit;
  edit.type = "orthographic";
  const Camera parallel = good(edited(pinhole, edit, nowhere));
  const float height = std::get<OrthographicCamera>(parallel).height;
  EXPECT_NEAR(static_cast<double>(height), 20 * std::tan(20 * std::acos(-1.0) / 180), 1e-5);
  edit.type = "thin_lens";
  const Camera back = good(edited(parallel, edit, nowhere));
  EXPECT_NEAR(static_cast<double>(std::get<ThinLensCamera>(back).fov), 40, 1e-4);
  EXPECT_EQ(std::get<ThinLensCamera>(back).fov_axis, FovAxis::y);
}

/// The camera of a scene file that has this text.
Camera camera_of(const std::string& text, const Vec3d& origin) {
  SceneFileOptions options;
  const std::string start = "schema = 1\norigin = [" + shortest(origin.x) + ", " +
                            shortest(origin.y) + ", " + shortest(origin.z) + "]\n";
  auto read = load_scene_text(start + text, "test.toml", options);
  if (!read) ADD_FAILURE() << format_diagnostic(read.error()) << "\n" << start + text;
  return read ? read.value().scene.camera.value_or(Camera{}) : Camera{};
}

TEST(CameraEdit, TextsReadBackAsTheSameFloats) {
  test::CaseRandom random(5);
  for (int i = 0; i < 200; ++i) {
    const auto point = [&](double scale) {
      return vec_cast<float>(Vec3d{random.uniform(-scale, scale), random.uniform(-scale, scale),
                                   random.uniform(-scale, scale)});
    };
    const double scale = std::pow(10, random.uniform(-6, 6));
    const CameraPose pose{point(scale), point(scale), {0.1F, 1, 0.2F}};
    const auto angle = static_cast<float>(random.uniform(1, 170));
    const Camera cameras[] = {PinholeCamera{pose, angle, FovAxis::max},
                              OrthographicCamera{pose, angle}, FisheyeCamera{pose, angle},
                              ThinLensCamera{pose, angle, FovAxis::x, 0.25F, 3.7F},
                              ThinLensCamera{pose, angle, FovAxis::x, 0.1F, {}}};
    for (const Vec3d& origin : {Vec3d{}, Vec3d{1234567.25, -3e5, 17}}) {
      for (const Camera& camera : cameras) {
        // The same text again means the same numbers.
        const std::string text = camera_toml(camera, origin);
        EXPECT_EQ(camera_toml(camera_of(text, origin), origin), text);
        const std::string keys = camera_keys(camera, origin);
        const Camera read = camera_of("camera = {" + keys + "}\n", origin);
        EXPECT_EQ(camera_keys(read, origin), keys);
        // Far from 0, the file's own doubles may be too coarse for a float near the origin.
        if (!(origin == Vec3d{})) continue;
        const auto pose_of = [](const auto& any) { return any.pose; };
        EXPECT_EQ(std::visit(pose_of, read).eye, pose.eye);
        EXPECT_EQ(std::visit(pose_of, read).look_at, pose.look_at);
      }
    }
  }
}

}  // namespace
}  // namespace boule::view
