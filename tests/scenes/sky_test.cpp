#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/math/warp.h"
#include "render/image/read_image.h"
#include "render/prepare/environment_light.h"
#include "tests/scenes/shipped.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

ProgramRun run_sky(const std::vector<std::string>& arguments) {
  return run_program(BOULE_SKY, {arguments, {}});
}

Image sky_of(const std::string& elevation, const std::string& height) {
  const TempDir dir;
  const std::string path = (dir.path() / "sky.exr").string();
  const ProgramRun run = run_sky({elevation, height, path});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto image = read_image(path, PictureContent::colors);
  return image ? image.value() : Image();
}

TEST(Sky, MakesTheShippedPicture) {
  const Image made = sky_of("35", "128");
  const auto shipped = read_image((scenes_folder() / "sky.exr").string(), PictureContent::colors);
  ASSERT_TRUE(shipped) << shipped.error().message;
  EXPECT_EQ(made.pixels, shipped.value().pixels);
}

/// Looked at as an environment, the sky shows the sun straight ahead at the height asked for, is
/// blue straight up, pale at the horizon, and the same on both sides.
TEST(Sky, SunIsWhereAsked) {
  for (const int elevation : {1, 35, 89}) {
    const Image image = sky_of(std::to_string(elevation), "64");
    const EnvironmentBackground sky{image.width, image.height, image.pixels, 0};
    const Angle up = full_turns(elevation / 360.0);
    const Color sun = environment_radiance(sky, {0, up.sine, -up.cosine});
    for (const Color& c : image.pixels) EXPECT_LE(c.g, 1.001f * sun.g);
    EXPECT_GT(sun.g, 20) << elevation;
  }
  const Image image = sky_of("35", "64");
  const EnvironmentBackground sky{image.width, image.height, image.pixels, 0};
  const Color zenith = environment_radiance(sky, {0, 1, 0});
  EXPECT_GT(zenith.b, 2 * zenith.r);
  const Color left = environment_radiance(sky, {-1, 0, 0});
  const Color right = environment_radiance(sky, {1, 0, 0});
  EXPECT_GT(left.r, zenith.r);
  EXPECT_NEAR(left.r, right.r, 1e-3);
}

TEST(Sky, RefusesOtherArguments) {
  const TempDir dir;
  const std::string path = (dir.path() / "sky.exr").string();
  const std::vector<std::vector<std::string>> wrong = {{"0", "64", path},    {"90", "64", path},
                                                       {"3x", "64", path},   {"35", "15", path},
                                                       {"35", "1025", path}, {"35", "64"}};
  for (const auto& arguments : wrong) {
    const ProgramRun run = run_sky(arguments);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, testing::StartsWith("usage: "));
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  const ProgramRun run = run_sky({"35", "16", (dir.path() / "no" / "sky.exr").string()});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, testing::HasSubstr("cannot write"));
}

}  // namespace
}  // namespace boule::test
