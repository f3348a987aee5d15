#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "tests/render/files/particle_file/read_text.h"

// Trajectories of runs that were killed: the file ends somewhere in a frame.

namespace boule::cut_frames {
namespace {

using test::particle_error;
using test::TempDir;
using testing::HasSubstr;

struct Trajectory {
  std::string ending, frame;
  /// Sizes of a part that is taken for a whole frame, or for none: in its last number, behind it,
  /// and where no atom's record has begun.
  std::size_t quiet = 0;
  bool by_gemmi = false;
};

void PrintTo(const Trajectory& trajectory, std::ostream* out) { *out << trajectory.ending; }

const std::string xyz = "2\nLattice=\"9 0 0 0 9 0 0 0 9\"\nC 0.5 1.5 2.5\nO 3.25 4.25 5.25\n";
const std::string dump =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 4\n0 4\n0 4.5\n"
    "ITEM: ATOMS id type x y z\n1 1 1.5 1.5 1.5\n2 1 2.5 2.5 2.5\n";
const std::string gro =
    "water t= 1.0\n2\n    1SOL     OW    1   0.230   0.628   1.113\n"
    "    1SOL    HW1    2   0.260   0.690   1.128\n   1.82060   1.82060   1.82060\n";
const std::string atom = "  CA  ALA A   1       1.000   2.000   3.000  1.00  0.00           C\n";
const std::string pdb = "MODEL        1\nATOM      1" + atom + "ATOM      2" + atom + "ENDMDL\n";
const std::string pqr =
    "MODEL        1\nATOM 1 N ALA 1 1.5 2.5 3.5 0.25 1.5\n"
    "ATOM 2 C ALA 1 1.5 2.5 3.5 0.25 1.5\nENDMDL\n";

/// At most 65535 bytes as gzip has what it cannot pack, without the checksum behind them.
std::string gzip_without_end(const std::string& text) {
  std::string packed("\x1f\x8b\x08\0\0\0\0\0\0\x03\x01", 11);
  const auto size = static_cast<unsigned>(text.size());
  for (const unsigned number : {size, ~size}) {
    packed += static_cast<char>(number & 255U);
    packed += static_cast<char>(number >> 8 & 255U);
  }
  return packed + text;
}

/// What frame `frame` of a file is: how many particles and notes it has, or an error.
std::string reading(const std::string& name, const std::string& bytes, long frame) {
  const auto read = test::read_particles(name, bytes, {}, frame);
  if (!read) return read.error().message;
  std::string text = std::to_string(read.value().size());
  for (const std::string& note : read.value().notes) {
    if (note.starts_with("the file is cut off")) text += " " + note;
  }
  return text;
}

class CutFrames : public testing::TestWithParam<Trajectory> {
 protected:
  void SetUp() override {
    if (GetParam().by_gemmi && !has_gemmi()) GTEST_SKIP() << "built without gemmi";
  }
};

/// Wherever two frames and a part are cut, the two are read, and each byte less than the last
/// number of the third frame has makes a note.
TEST_P(CutFrames, WholeFramesAreReadFromAnyCut) {
  const auto& [ending, frame, quiet, by_gemmi] = GetParam();
  const std::string name = "a." + ending, two = frame + frame;
  const std::string all = reading(name, two, 0);
  EXPECT_EQ(all, "2");
  std::size_t told = 0;
  for (std::size_t size = 1; size < frame.size(); ++size) {
    const std::string bytes = two + frame.substr(0, size);
    EXPECT_THAT(reading(name, bytes, 0), HasSubstr("2")) << size;
    EXPECT_THAT(reading(name, bytes, 1), testing::StartsWith("2")) << bytes;
    const std::string last = reading(name, bytes, 2);
    if (last.starts_with(
            "there is no frame 2, it has 2 frames: the file is cut off in frame 2 (")) {
      EXPECT_THAT(reading(name, bytes, -1), HasSubstr("2 the file is cut off in frame 2 (line "));
      ++told;
    }
  }
  EXPECT_EQ(told + quiet, frame.size() - 1);
}

TEST_P(CutFrames, AFileOfNothingElseIsRefused) {
  const auto& [ending, frame, quiet, by_gemmi] = GetParam();
  EXPECT_NE(particle_error("a." + ending, frame.substr(0, frame.size() / 3)), "no error");
}

INSTANTIATE_TEST_SUITE_P(Formats, CutFrames,
                         testing::Values(Trajectory{"xyz", xyz, 4}, Trajectory{"dump", dump, 3},
                                         Trajectory{"gro", gro, 7},
                                         Trajectory{"pdb", pdb, 50, true},
                                         Trajectory{"pqr", pqr, 25}),
                         [](const auto& test) { return test.param.ending; });

TEST(CutFrame, IsToldWithItsLine) {
  EXPECT_EQ(
      reading("a.xyz", xyz + "3\n\nC 0 0 0\nC 1 0 0\n", -1),
      "2 the file is cut off in frame 1 (line 5: it promises 3 particles, the file ends after "
      "2)");
  EXPECT_EQ(
      reading("a.xyz", xyz + "3\n", -1),
      "2 the file is cut off in frame 1 (line 5: it promises 3 particles, the file ends after "
      "0)");
  EXPECT_EQ(
      reading("a.xyz", xyz + "2\n\nC 0 0 0\nC 1 0", -1),
      "2 the file is cut off in frame 1 (line 5: it promises 2 particles, the file ends in the "
      "last of them)");
  EXPECT_EQ(
      reading("a.dump", dump + dump.substr(0, dump.size() - 10), 1),
      "there is no frame 1, it has 1 frame: the file is cut off in frame 1 (line 22: the file "
      "ends in the last row of its atoms)");
  EXPECT_EQ(reading("a.dump", dump + "ITEM: TI", -1),
            "2 the file is cut off in frame 1 (line 12: the file ends in this header)");
  EXPECT_EQ(reading("a.gro", gro + gro.substr(0, gro.size() - 12), -1),
            "2 the file is cut off in frame 1 (line 10: the file ends in its box)");
}

TEST(CutFrame, IsNoneWhereTheFileIsWhole) {
  // Without an end of the last line, and with blank lines behind it.
  for (const Trajectory& whole : {Trajectory{"xyz", xyz}, {"dump", dump}, {"gro", gro}}) {
    const std::string two = whole.frame + whole.frame;
    EXPECT_EQ(reading("a." + whole.ending, two.substr(0, two.size() - 1), -1), "2");
    EXPECT_EQ(reading("a." + whole.ending, two + "\n \n", -1), "2");
  }
  // What is wrong in the middle stays an error.
  EXPECT_THAT(reading("a.xyz", xyz + "3\n\nC 0 0 0\nC 1 0 0\n" + xyz, 0),
              HasSubstr("expected a count of particles"));
  EXPECT_THAT(reading("a.dump", dump + "more\n", 0), HasSubstr("expected ITEM: and its name"));
}

TEST_P(CutFrames, WholeFramesOfPackedBytesAreRead) {
  const auto& [ending, frame, quiet, by_gemmi] = GetParam();
  std::string text;
  for (int i = 0; i < 100; ++i) text += frame;
  const std::string packed = gzip_without_end(text);
  const std::string bytes = packed.substr(0, packed.size() / 2);
  const std::string name = "a." + ending + ".gz";
  EXPECT_THAT(
      reading(name, packed, 99),
      testing::StartsWith("2 the file is cut off behind frame 99: its gzip data are damaged"));
  EXPECT_THAT(reading(name, bytes, 0), testing::StartsWith("2 the file is cut off "));
  EXPECT_THAT(reading(name, bytes, -1), testing::StartsWith("2 the file is cut off "));
  EXPECT_THAT(reading(name, bytes, 99), HasSubstr("there is no frame 99"));
  const std::string one = gzip_without_end(frame);
  EXPECT_THAT(reading(name, one.substr(0, one.size() / 2), 0),
              HasSubstr("its gzip data are damaged: the file ends before them"));
}

TEST(CutFrame, OfPdbIsKnownByEarlierFrames) {
  if (!has_gemmi()) GTEST_SKIP() << "built without gemmi";
  const std::string one = "ATOM      1" + atom, end = "END\n";
  EXPECT_EQ(
      reading("a.pdb", one + one + end + one + one + end + one, -1),
      "2 the file is cut off in frame 2 (line 7: the file ends after 1 of its atoms, the frame "
      "before has 2)");
  // Molecules one after the other are no trajectory.
  EXPECT_EQ(reading("a.pdb", one + one + end + one, -1), "1");
  EXPECT_EQ(reading("a.pdb", one + one + end + one + end + one, -1), "1");
}

}  // namespace
}  // namespace boule::cut_frames
