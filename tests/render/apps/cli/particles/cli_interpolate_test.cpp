// Pictures between the frames of a series.
#include <filesystem>

#include "tests/render/apps/cli/particles/particles_fixture.h"

namespace boule::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Interpolation : public ParticlesTest {
 protected:
  static std::string frame_of(const std::string& x, const std::string& time) {
    return "2\nLattice=\"16 0 0 0 16 0 0 0 16\" Properties=species:S:1:pos:R:3 Time=" + time +
           "\nC " + x + " 4 4\nN 8 8 8\n";
  }
  ProgramRun series(const std::string& file, const std::string& pictures,
                    const std::vector<std::string>& options) const {
    std::vector<std::string> all{"--quick", "--view", "-z", "--up", "y"};
    all.insert(all.end(), options.begin(), options.end());
    return render(file, pictures, all);
  }
};

TEST_F(Interpolation, MakesThePicturesOfFinerFrames) {
  const std::string sparse =
      write("sparse.xyz", frame_of("15", "0") + frame_of("3", "4") + frame_of("5", "8"));
  // 16 upward is the face: 15, 16, 17, 18, 19.
  const std::string fine =
      write("fine.xyz", frame_of("15", "0") + frame_of("16", "1") + frame_of("1", "2") +
                            frame_of("2", "3") + frame_of("3", "4") + frame_of("3.5", "5") +
                            frame_of("4", "6") + frame_of("4.5", "7") + frame_of("5", "8"));
  const std::vector<std::string> camera{"--camera", "eye = [8, 8, 40], look_at = [8, 8, 8]"};
  std::vector<std::string> options = camera;
  options.insert(options.end(), {"--overlay", "time", "--frames", "0-8"});
  series(fine, "fine#.ppm", options);
  options.back() = "0-2";
  options.insert(options.end(), {"--interpolate", "4"});
  const ProgramRun run = series(sparse, "sparse#.ppm", options);
  for (int i = 0; i <= 8; ++i) {
    const std::string number = std::to_string(i) + ".ppm";
    EXPECT_TRUE(read("fine" + number) == read("sparse" + number)) << i;
  }
  EXPECT_FALSE(std::filesystem::exists(path("sparse9.ppm")));
  EXPECT_THAT(run.err, HasSubstr("9 frames"));
  // Any part of the series has the same pictures.
  options[options.size() - 3] = "1-2";
  options.insert(options.end(), {"--claim"});
  series(sparse, "part#.ppm", options);
  EXPECT_FALSE(std::filesystem::exists(path("part3.ppm")));
  EXPECT_TRUE(read("part6.ppm") == read("sparse6.ppm"));
}

TEST_F(Interpolation, MovesFilesOfNumberedNames) {
  write("run.0.xyz", frame_of("2", "0"));
  write("run.1.xyz", frame_of("6", "2"));
  const std::string middle = write("middle.xyz", frame_of("4", "1"));
  const std::vector<std::string> camera{"--camera", "eye = [8, 8, 40], look_at = [8, 8, 8]"};
  std::vector<std::string> options = camera;
  options.insert(options.end(), {"--frames", "0-1", "--interpolate", "2"});
  series(path("run.#.xyz"), "p#.ppm", options);
  series(middle, "middle.ppm", camera);
  EXPECT_TRUE(read("p1.ppm") == read("middle.ppm"));
}

TEST_F(Interpolation, IsRefusedWhereItCannotBe) {
  const std::string file =
      write("other.xyz", frame_of("1", "0") + "1\nLattice=\"16 0 0 0 16 0 0 0 16\"\nC 0 0 0\n");
  const auto refused = [&](const std::vector<std::string>& options, int code) {
    std::vector<std::string> all{"render", file, "-o", path("r#.ppm"), "--quick"};
    all.insert(all.end(), options.begin(), options.end());
    return refused_run(all, code).err;
  };
  EXPECT_THAT(refused({"--interpolate", "2"}, 2), HasSubstr("--frames is missing"));
  EXPECT_THAT(refused({"--interpolate", "2", "--frames", "0-4:2"}, 2), HasSubstr("without a step"));
  EXPECT_THAT(refused({"--interpolate", "2", "--turn", "4"}, 2), HasSubstr("not of --turn"));
  EXPECT_THAT(refused({"--interpolate", "1", "--frames", "0-1"}, 2), HasSubstr("from 2 to 1000"));
}

TEST_F(Interpolation, NeedsTheSameParticles) {
  const std::string file = write("other.xyz", frame_of("1", "0") + "1\n\nC 0 0 0\n");
  const ProgramRun run = boule_run({"render", file, "-o", path("r#.ppm"), "--quick", "--size",
                                    "40x30", "--frames", "0-1", "--interpolate", "2"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("a frame has 2 particles, the next one 1"),
                             HasSubstr("other.xyz"), HasSubstr("frame 1")));
  EXPECT_FALSE(std::filesystem::exists(path("r1.ppm")));
}

}  // namespace
}  // namespace boule::test
