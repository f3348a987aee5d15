// What reading particles takes at its peak: text, positions and spheres never stand there whole
// at the same time.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "core/math/random.h"
#include "render/files/scene_file/scene_file.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

/// A figure of this process in bytes ("VmRSS"); 0 if the system does not tell.
std::uint64_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with(name + ":")) continue;
    std::uint64_t kibibytes = 0;
    std::istringstream(line.substr(name.size() + 1)) >> kibibytes;
    return kibibytes * 1024;
  }
  return 0;
}

/// Makes what is in memory now the peak ("VmHWM") from which the next is counted.
bool forget_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

void write_particles(const std::filesystem::path& path, std::size_t count) {
  std::ofstream file(path);
  file << count << "\nexample\n";
  for (std::size_t i = 0; i < count; ++i) {
    file << "CNOH"[i % 4];
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      const std::uint64_t bits = mix64(3 * i + axis) >> 44;
      file << ' ' << bits / 10000 << '.' << 10000 + bits % 10000;
    }
    file << '\n';
  }
}

/// 24 bytes are a position and 4 a species, or 20 a sphere; the portion that is both takes 3 of
/// them. It would be 60 if text, positions, radii, colours and spheres were all there at the end.
TEST(ParticleMemory, PositionsLeaveAsSpheresAppear) {
  const std::size_t count = 1500000;
  const TempDir folder;
  const auto path = folder.path() / "cloud.xyz";
  write_particles(path, count);
  if (!forget_peak()) GTEST_SKIP() << "this system does not tell peaks";
  const std::uint64_t before = status_bytes("VmRSS");
  const auto loaded = load_scene_text(
      "schema = 1\n[[particles]]\nfile = \"" + path.string() + "\"\n", "scene.toml", {});
  const std::uint64_t peak = status_bytes("VmHWM");
  ASSERT_TRUE(loaded.ok());
  ASSERT_EQ(loaded.value().scene.spheres.size(), count);
  EXPECT_LT(peak - before, 36 * count);
}

}  // namespace
}  // namespace boule::test
