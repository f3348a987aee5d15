#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "render/files/scene_file/npy/npy_reader.h"
#include "tests/scenes/shipped.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

ProgramRun run_sphereflake(const std::string& depth, const std::string& file) {
  return run_program(BOULE_SPHEREFLAKE, {{depth, file}, {}});
}

TEST(Sphereflake, WritesTheShippedFileByteForByte) {
  const TempDir dir;
  const std::string path = (dir.path() / "flake.npy").string();
  ASSERT_EQ(run_sphereflake("3", path).exit_code, 0);
  const std::string made = read_bytes(path);
  EXPECT_EQ(made.size(), 128U + 820U * 16U);
  EXPECT_TRUE(made == read_bytes(scenes_folder() / "sphereflake.npy"));
}

TEST(Sphereflake, HasNineChildrenPerSphere) {
  const TempDir dir;
  const std::string path = (dir.path() / "flake.npy").string();
  std::size_t count = 0, generation = 1;
  for (int depth = 0; depth <= 4; ++depth, generation *= 9) {
    count += generation;
    ASSERT_EQ(run_sphereflake(std::to_string(depth), path).exit_code, 0);
    std::vector<Sphere> spheres;
    const auto done = append_spheres({path, {}, 0}, spheres);
    ASSERT_TRUE(done) << format_diagnostic(done.error());
    EXPECT_EQ(spheres.size(), count);
  }
}

TEST(Sphereflake, RefusesOtherDepths) {
  const TempDir dir;
  const std::string path = (dir.path() / "flake.npy").string();
  for (const char* depth : {"-1", "7", "3x", "", "deep"}) {
    const ProgramRun run = run_sphereflake(depth, path);
    EXPECT_EQ(run.exit_code, 2) << depth;
    EXPECT_THAT(run.err, testing::StartsWith("usage: "));
    EXPECT_FALSE(std::filesystem::exists(path)) << depth;
  }
}

TEST(Sphereflake, ReportsWhatItCannotWrite) {
  const TempDir dir;
  const ProgramRun run = run_sphereflake("0", (dir.path() / "none" / "flake.npy").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, testing::StartsWith("error: cannot write"));
}

}  // namespace
}  // namespace boule::test
