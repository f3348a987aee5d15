#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "render/files/scene_file/npy/npy_reader.h"
#include "tests/scenes/shipped.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

ProgramRun run_lecture_objects(const std::string& object, const std::string& file) {
  return run_program(BOULE_LECTURE_OBJECTS, {{object, file}, {}});
}

TEST(LectureObjects, AreTheShippedFilesByteForByte) {
  const TempDir dir;
  for (const char* object : {"bunny", "teapot", "table"}) {
    const std::string path = (dir.path() / "object.npy").string();
    ASSERT_EQ(run_lecture_objects(object, path).exit_code, 0);
    const std::string shipped = read_bytes(scenes_folder() / (std::string(object) + ".npy"));
    EXPECT_FALSE(shipped.empty()) << object;
    EXPECT_TRUE(read_bytes(path) == shipped) << object;
  }
}

/// No object sinks into the ground or hovers above it.
TEST(LectureObjects, StandOnTheirGround) {
  for (const char* object : {"bunny", "teapot", "table"}) {
    std::vector<Sphere> spheres;
    const std::string path = (scenes_folder() / (std::string(object) + ".npy")).string();
    ASSERT_TRUE(append_spheres({path, {}, 0}, spheres));
    float lowest = 1;
    for (const Sphere& s : spheres) lowest = std::min(lowest, s.center.y - s.radius);
    EXPECT_NEAR(lowest, 0, 0.005) << object;
  }
}

TEST(LectureObjects, RefusesOtherNames) {
  const TempDir dir;
  const std::string path = (dir.path() / "object.npy").string();
  for (const char* object : {"", "Bunny", "dragon"}) {
    const ProgramRun run = run_lecture_objects(object, path);
    EXPECT_EQ(run.exit_code, 2) << object;
    EXPECT_THAT(run.err, testing::StartsWith("usage: "));
    EXPECT_FALSE(std::filesystem::exists(path)) << object;
  }
  EXPECT_EQ(run_lecture_objects("bunny", (dir.path() / "none" / "b.npy").string()).exit_code, 1);
}

}  // namespace
}  // namespace boule::test
