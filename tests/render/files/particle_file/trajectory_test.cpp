#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "render/files/particle_file/particle_file.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

// Trajectories whose frames are found once and then read by themselves.

namespace boule::trajectory {
namespace {

constexpr int frames = 500, atoms = 3000;

std::string xyz_frame(int frame) {
  std::string text = std::to_string(atoms) + "\nframe " + std::to_string(frame) + "\n";
  for (int i = 0; i < atoms; ++i) {
    text += "Ar " + std::to_string(frame) + " " + std::to_string(i) + ".25 -17.0625000000\n";
  }
  return text;
}

std::string dump_frame(int frame) {
  std::string text = "ITEM: TIMESTEP\n" + std::to_string(frame) + "\nITEM: NUMBER OF ATOMS\n" +
                     std::to_string(atoms) +
                     "\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n";
  for (int i = 0; i < atoms; ++i) {
    text += std::to_string(i + 1) + " " + std::to_string(frame) + " " + std::to_string(i) +
            ".25 -17.0625000000\n";
  }
  return text;
}

/// A file of many frames, 16 MiB at least, so that it is mapped; and where each frame begins.
struct Trajectory {
  std::string path;
  std::vector<std::size_t> begins;  ///< and the end of the last
};

Trajectory write_trajectory(const std::string& path, std::string (*frame_text)(int)) {
  Trajectory written{path, {0}};
  std::ofstream file(path, std::ios::binary);
  for (int i = 0; i < frames; ++i) {
    const std::string text = frame_text(i);
    file << text;
    written.begins.push_back(written.begins.back() + text.size());
  }
  EXPECT_TRUE(file.flush().good());
  return written;
}

/// Overwrites bytes of a file that stays as long as it is.
void destroy(const Trajectory& trajectory, std::size_t begin, std::size_t end) {
  std::fstream file(trajectory.path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(static_cast<std::streamoff>(begin));
  file << std::string(end - begin, '?');
  EXPECT_TRUE(file.flush().good());
}

class Trajectories : public testing::TestWithParam<std::string> {};

TEST_P(Trajectories, MiddleFrameIsReadAlone) {
  const test::TempDir folder;
  const Trajectory written = write_trajectory(folder.path() / ("run." + GetParam()),
                                              GetParam() == "xyz" ? xyz_frame : dump_frame);
  ASSERT_GT(written.begins.back(), std::size_t{16} << 20);
  auto file = ParticleFile::open(written.path);
  ASSERT_TRUE(file.ok()) << format_diagnostic(file.error());
  ASSERT_EQ(file.value().frames(), std::size_t{frames});
  // Nothing but this frame is there any more: what else were read would be seen.
  constexpr std::size_t middle = frames / 2;
  destroy(written, 0, written.begins[middle]);
  destroy(written, written.begins[middle + 1], written.begins.back());
  const auto read = file.value().read(static_cast<long>(middle));
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  ASSERT_EQ(read.value().size(), std::size_t{atoms});
  for (std::size_t i = 0; i < read.value().size(); ++i) {
    const double y = static_cast<double>(i) + 0.25;
    ASSERT_EQ(read.value().positions[i], (Vec3d{double{middle}, y, -17.0625}));
  }
  // A file that changes while it is open does no harm.
  for (const long frame : {0L, 1L, 2L, -1L}) EXPECT_FALSE(file.value().read(frame).ok());
}

INSTANTIATE_TEST_SUITE_P(Formats, Trajectories, testing::Values("xyz", "dump"),
                         [](const testing::TestParamInfo<std::string>& test) {
                           return test.param;
                         });

}  // namespace
}  // namespace boule::trajectory
