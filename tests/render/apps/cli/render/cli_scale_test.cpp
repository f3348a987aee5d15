// Ten million spheres in 2.5 GiB, addresses and all; what takes long is told.
#include <nlohmann/json.hpp>

#include "core/math/random.h"
#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"
#include "tests/support/test_size.h"

namespace boule::test {
namespace {

class Scale : public ProgramTest {
 protected:
  /// A cube of small spheres as a .npy file: centre and radius, float32.
  void write_cloud(std::size_t count) const {
    std::string header =
        "{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(count) + ", 4), }";
    header.resize(117, ' ');
    std::ofstream file(path("cloud.npy"), std::ios::binary);
    file << std::string("\x93NUMPY\x01\0\x76\0", 10) << header << '\n';
    const auto radius = static_cast<float>(0.4 / std::cbrt(static_cast<double>(count)));
    std::vector<float> rows;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k) {
        rows.push_back(static_cast<float>(mix64(bits += golden_step) >> 40) * 0x1p-23f - 1);
      }
      rows.push_back(radius);
      if (rows.size() < 4096 && i + 1 < count) continue;
      file.write(reinterpret_cast<const char*>(rows.data()),
                 static_cast<std::streamsize>(rows.size() * sizeof(float)));
      rows.clear();
    }
    ASSERT_TRUE(file.good());
  }
  std::string cloud_scene() const {
    return write("scene.toml",
                 "schema = 1\n[camera]\neye = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
                 "[[light]]\nposition = [3, 5, 4]\n[[spheres]]\nfile = \"cloud.npy\"\n");
  }
  ProgramRun limited(std::size_t mebibytes, std::vector<std::string> arguments) const {
    const std::string line = "ulimit -v " + std::to_string(mebibytes * 1024) + "; exec \"$@\"";
    arguments.insert(arguments.begin(), {"-c", line, "sh", BOULE_PROGRAM});
    return run_program("/bin/sh", {arguments, {}});
  }
};

/// BOULE_SCALE_SPHERES: another number, with memory in proportion.
TEST_F(Scale, MillionsOfSpheresFit) {
  const std::size_t count = test_size("BOULE_SCALE_SPHERES", 10000000);
  const std::size_t mebibytes = 2560 * (count / 1000000) / 10;
  write_cloud(count);
  const ProgramRun run = limited(
      mebibytes, {"render", cloud_scene(), "-o", path("cloud.exr"), "--size", "160x120", "-t", "2",
                  "--stats", "json:" + path("stats.json"), "--progress", "json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto stats = nlohmann::json::parse(read("stats.json"));
  EXPECT_LT(stats["peak_rss_mib"].get<double>(), static_cast<double>(mebibytes));
  for (const char* const stage : {"load", "prepare", "render", "total"}) {
    RecordProperty(stage, std::to_string(stats["seconds"][stage].get<double>()));
  }
  RecordProperty("peak_rss_mib", std::to_string(stats["peak_rss_mib"].get<double>()));
  EXPECT_THAT(run.err, testing::HasSubstr("{\"share\":1.0000,"));
}

/// It takes long for as long as it is held.
TEST_F(Scale, ReadingThatTakesLongIsTold) {
  write_cloud(1000);
  const std::string scene = cloud_scene();
  RunningProgram program({"render", scene, "-o", path("cloud.ppm"), "--size", "16x12"},
                         Hold{"read", path("cloud.npy")});
  EXPECT_TRUE(program.wait_for_hold());
  EXPECT_TRUE(program.wait_for("boule: reading "));
  program.let_go();
  EXPECT_EQ(program.finish().exit_code, 0);
}

TEST_F(Scale, TooLargeInputIsRefusedUnread) {
  write_cloud(5000000);
  const std::string scene = cloud_scene();
  const auto before = files();
  const ProgramRun run = limited(150, {"render", scene, "-o", path("cloud.exr")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, testing::HasSubstr("'cloud.npy': 5000000 spheres need "));
  EXPECT_THAT(run.err, testing::HasSubstr(" MiB of memory, there are "));
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace boule::test
