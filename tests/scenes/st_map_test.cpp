#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "render/image/read_image.h"
#include "tests/scenes/shipped.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

ProgramRun run_st_map(const std::vector<std::string>& arguments) {
  return run_program(BOULE_ST_MAP, {arguments, {}});
}

Image map_of(const std::string& amount, const std::string& width, const std::string& height) {
  const TempDir dir;
  const std::string path = (dir.path() / "map.exr").string();
  const ProgramRun run = run_st_map({amount, width, height, path});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto image = read_image(path, PictureContent::numbers);
  return image ? image.value() : Image();
}

TEST(StMap, MakesTheShippedMap) {
  const Image made = map_of("0.6", "64", "36");
  const auto shipped =
      read_image((scenes_folder() / "barrel.exr").string(), PictureContent::numbers);
  ASSERT_TRUE(shipped) << shipped.error().message;
  EXPECT_EQ(made.pixels, shipped.value().pixels);
}

TEST(StMap, WithoutAmountIsTheIdentity) {
  const Image map = map_of("0", "8", "4");
  ASSERT_EQ(map.pixels.size(), 32U);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 8; ++i) {
      const auto x = static_cast<float>(i), y = static_cast<float>(j);
      EXPECT_FLOAT_EQ(map.at(i, j).r, (x + 0.5f) / 8);
      EXPECT_FLOAT_EQ(map.at(i, j).g, 1 - (y + 0.5f) / 4);
    }
  }
}

TEST(StMap, BarrelsBulgeAndPincushionsPinch) {
  // How much of the film a step of one pixel covers, in the middle and at the right edge.
  const auto steps = [](const char* amount) {
    const Image map = map_of(amount, "100", "50");
    return std::pair{map.at(50, 25).r - map.at(49, 25).r, map.at(99, 25).r - map.at(98, 25).r};
  };
  const auto [barrel_middle, barrel_edge] = steps("0.5");
  EXPECT_LT(barrel_middle, barrel_edge);
  const auto [pincushion_middle, pincushion_edge] = steps("-0.2");
  EXPECT_GT(pincushion_middle, pincushion_edge);
}

TEST(StMap, RefusesOtherArguments) {
  const TempDir dir;
  const std::string path = (dir.path() / "map.exr").string();
  const std::vector<std::vector<std::string>> wrong = {
      {"-0.4", "8", "4", path}, {"5", "8", "4", path},      {"0.1x", "8", "4", path},
      {"0.1", "1", "4", path},  {"0.1", "8", "5000", path}, {"0.1", "8", "4"}};
  for (const auto& arguments : wrong) {
    const ProgramRun run = run_st_map(arguments);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.err, testing::StartsWith("usage: "));
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  const ProgramRun run = run_st_map({"0.1", "8", "4", (dir.path() / "no" / "map.exr").string()});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, testing::HasSubstr("cannot write"));
}

}  // namespace
}  // namespace boule::test
