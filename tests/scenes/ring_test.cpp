#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "render/files/scene_file/npy/npy_reader.h"
#include "tests/scenes/shipped.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

ProgramRun run_ring(const std::string& count, const std::string& file) {
  return run_program(BOULE_RING, {{count, file}, {}});
}

TEST(Ring, HasAPlanetAndRingParticles) {
  const TempDir dir;
  const std::string path = (dir.path() / "ring.npy").string();
  ASSERT_EQ(run_ring("5000", path).exit_code, 0);
  std::vector<Sphere> spheres;
  const auto done = append_spheres({path, {}, 0}, spheres);
  ASSERT_TRUE(done) << format_diagnostic(done.error());
  ASSERT_EQ(spheres.size(), 5000U);
  EXPECT_EQ(spheres[0].radius, 1);
  for (std::size_t i = 1; i < spheres.size(); ++i) {
    const auto& [center, radius, material] = spheres[i];
    const double distance = std::hypot(double{center.x}, double{center.z});
    ASSERT_GE(distance, 1.24 - 1e-6) << i;
    ASSERT_LE(distance, 2.27 + 1e-6) << i;
    ASSERT_FALSE(distance > 1.95 + 1e-6 && distance < 2.03 - 1e-6) << i << " lies in the gap";
    ASSERT_GT(radius, 0) << i;
    ASSERT_LT(std::fabs(center.y), 0.5) << i;
  }
}

TEST(Ring, WritesTheSameToStandardOutput) {
  const TempDir dir;
  const std::string path = (dir.path() / "ring.npy").string();
  ASSERT_EQ(run_ring("1000", path).exit_code, 0);
  const ProgramRun piped = run_ring("1000", "-");
  EXPECT_EQ(piped.exit_code, 0);
  EXPECT_TRUE(piped.out == read_bytes(path));
}

TEST(Ring, RefusesOtherCounts) {
  const TempDir dir;
  const std::string path = (dir.path() / "ring.npy").string();
  for (const char* count : {"-1", "1", "4000000001", "3x", "", "many"}) {
    const ProgramRun run = run_ring(count, path);
    EXPECT_EQ(run.exit_code, 2) << count;
    EXPECT_THAT(run.err, testing::StartsWith("usage: "));
    EXPECT_FALSE(std::filesystem::exists(path)) << count;
  }
}

TEST(Ring, ReportsWhatItCannotWrite) {
  const TempDir dir;
  const ProgramRun run = run_ring("2", (dir.path() / "none" / "ring.npy").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, testing::StartsWith("error: cannot write"));
}

}  // namespace
}  // namespace boule::test
