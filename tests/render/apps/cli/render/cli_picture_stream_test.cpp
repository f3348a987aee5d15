// Pictures on standard output: nothing else is there, and a stream of them is one after the other.
#include <cstdlib>
#include <optional>

#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class PictureStream : public ProgramTest {
 protected:
  ProgramRun run(std::vector<std::string> options) const {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return boule_run(arguments);
  }
  /// The bytes of the file that the same command writes.
  std::string file_bytes(const std::string& name, std::vector<std::string> options = {}) const {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path(name)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(boule_run(arguments).exit_code, 0);
    return read(name);
  }
  /// A scene whose camera comes nearer from frame to frame.
  std::string moving_scene() const {
    const std::string base = read_bytes(small_scene());
    const std::size_t end = base.find("[camera]"), next = base.find("[background]");
    return write("moving.toml", base.substr(0, end) +
                                    "[camera]\n[[camera.key]]\nframe = 1\neye = [0.0, 1.0, 5.0]\n"
                                    "look_at = [0.0, 0.8, 0.0]\n[[camera.key]]\nframe = 3\n"
                                    "eye = [0.0, 1.0, 3.0]\n" +
                                    base.substr(next));
  }
};

/// A binary PPM of 8 bits at the start of a stream, without the rest; none if there is no such.
struct Ppm {
  int width, height;
  std::string pixels;
};
std::optional<Ppm> take_ppm(std::string& stream) {
  int width = 0, height = 0, used = 0;
  if (std::sscanf(stream.c_str(), "P6\n%d %d\n255\n%n", &width, &height, &used) != 2 || used == 0) {
    return std::nullopt;
  }
  const auto begin = static_cast<std::size_t>(used);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3;
  if (stream.size() < begin + count) return std::nullopt;
  Ppm picture{width, height, stream.substr(begin, count)};
  stream.erase(0, begin + count);
  return picture;
}

TEST_F(PictureStream, HoldsThePixelsOfTheFile) {
  std::string file = file_bytes("p.ppm");
  const auto expected = take_ppm(file);
  ASSERT_TRUE(expected);
  ProgramRun ppm = run({"--format", "ppm"});
  EXPECT_EQ(ppm.exit_code, 0) << ppm.err;
  EXPECT_THAT(ppm.err, HasSubstr("standard output: 32 x 18 pixels"));
  const auto found = take_ppm(ppm.out);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->width, 32);
  EXPECT_EQ(found->height, 18);
  EXPECT_TRUE(found->pixels == expected->pixels);
  EXPECT_THAT(ppm.out, IsEmpty());
  EXPECT_TRUE(run({"--format", "rgb", "-q"}).out == expected->pixels);
}

TEST_F(PictureStream, HoldsThePngFile) {
  EXPECT_TRUE(run({"--format", "png"}).out == file_bytes("p.png"));
  const std::vector<std::string> transparent = {"--background", "transparent"};
  EXPECT_TRUE(run({"--format", "png", "--background", "transparent"}).out ==
              file_bytes("t.png", transparent));
}

TEST_F(PictureStream, SeriesStreamsPicturesInOrder) {
  const std::string scene = moving_scene();
  ProgramRun series =
      boule_run({"render", scene, "--frames", "1-3", "-o", "-", "--format", "ppm", "-v"});
  EXPECT_EQ(series.exit_code, 0) << series.err;
  for (const char* frame : {"1", "2", "3"}) {
    std::string alone =
        boule_run({"render", scene, "--frames", frame, "-o", "-", "--format", "ppm"}).out;
    const auto found = take_ppm(series.out), expected = take_ppm(alone);
    ASSERT_TRUE(found && expected) << frame;
    EXPECT_TRUE(found->pixels == expected->pixels) << frame;
  }
  EXPECT_THAT(series.out, IsEmpty());
}

TEST_F(PictureStream, AppendsToAFile) {
  const std::string command = "cd " + path("") + " && (echo first; \"" BOULE_PROGRAM "\" render " +
                              small_scene() + " -o - --format rgb -q) > all";
  EXPECT_EQ(run_program("/bin/sh", {{"-c", command}, {}}).exit_code, 0);
  EXPECT_EQ(read("all").size(), 6 + 32 * 18 * 3U);
}

TEST_F(PictureStream, LeavingReaderEndsItSilently) {
  const std::string command = "\"" BOULE_PROGRAM "\" render " + moving_scene() +
                              " --frames 1-3 --size 640x360 -q -o - --format ppm 2>" + path("err") +
                              "; echo $? >" + path("code");
  run_program("/bin/sh", {{"-c", "{ " + command + "; } | head -c 100 >/dev/null"}, {}});
  EXPECT_EQ(read("code"), "141\n");
  EXPECT_EQ(read("err"), "");
}

TEST_F(PictureStream, WantsOptionsThatFit) {
  const std::string scene = small_scene();
  const auto refused = [&](std::vector<std::string> options, const char* why) {
    std::vector<std::string> arguments = {"render", scene};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_THAT(refused_run(arguments, 2).err, HasSubstr(why));
  };
  refused({"-o", "-"}, "one of ppm, png, rgb (key '--format')");
  refused({"-o", "a.png", "--format", "png"}, "expected '-o -'");
  refused({"-o", "-", "--format", "jpg"}, "expected one of ppm|png|rgb");
  refused({"-o", "-", "--format", "ppm", "--stats", "json"}, "standard output has the picture");
  refused({"-o", "-", "--format", "ppm", "--skip-existing"}, "could be skipped");
  refused({"-o", "-", "--format", "ppm", "--aov", "depth"}, "no room for extra channels");
  refused({"-o", "-", "--format", "ppm", "--background", "transparent"}, "cannot be transparent");
}

TEST_F(PictureStream, MissingTargetFailsBeforeTheWork) {
  const std::string command =
      "\"" BOULE_PROGRAM "\" render " + small_scene() + " -o - --format ppm >&-";
  const ProgramRun closed = run_program("/bin/sh", {{"-c", command}, {}});
  EXPECT_EQ(closed.exit_code, 1);
  EXPECT_THAT(closed.err, HasSubstr("cannot write 'standard output': Bad file descriptor"));
}

TEST_F(PictureStream, MakesAMovie) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not here";
  const std::string command = "\"" BOULE_PROGRAM "\" render " + moving_scene() +
                              " --frames 1-3 -o - --format ppm -q | ffmpeg -v error -f image2pipe "
                              "-i - -f framemd5 - | grep -c '^0,'";
  EXPECT_EQ(run_program("/bin/sh", {{"-c", command}, {}}).out, "3\n");
}

}  // namespace
}  // namespace boule::test
