// Movies, turntables, and sizes in print. A program in place of ffmpeg keeps what it is given.
#include <sys/stat.h>

#include "core/base/text.h"
#include "tests/render/apps/cli/particles/particles_fixture.h"

namespace boule::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Movies : public ParticlesTest {
 protected:
  /// An environment whose ffmpeg is this script.
  std::vector<std::string> with_ffmpeg(const std::string& script) const {
    std::filesystem::create_directories(path("bin"));
    write("bin/ffmpeg", "#!/bin/sh\n" + script);
    chmod(path("bin/ffmpeg").c_str(), 0755);
    return {"PATH=" + path("bin") + ":/usr/bin:/bin"};
  }
  /// One that writes its arguments but the last, and then the pictures, into the movie.
  std::vector<std::string> honest() const {
    return with_ffmpeg(
        "all=\"$*\"\nfor movie; do :; done\n"
        "{ echo \"${all% *}\"; cat; } > \"$movie\"\n");
  }
  /// A command with the rest of its options.
  std::vector<std::string> command(const std::string& file, const std::string& output,
                                   std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"render", file, "-o", output, "--size", "16x12", "--quick"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

TEST_F(Movies, HaveAllFramesOfATrajectory) {
  const std::string file = growing(3);
  const ProgramRun run = boule_run(command(file, path("all.mp4"), {"--fps", "12.5"}), honest());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, HasSubstr("all.mp4: 3 frames"));
  const std::string movie = read("all.mp4");
  const std::size_t line = movie.find('\n') + 1;
  EXPECT_THAT(movie.substr(0, line), AllOf(HasSubstr("-framerate 12.5"), HasSubstr("-f mp4")));
  const ProgramRun stream = boule_run(command(file, "-", {"--format", "ppm", "--frames", "0-2"}));
  EXPECT_TRUE(movie.substr(line) == stream.out);
}

TEST_F(Movies, FormatsFollowTheEnding) {
  const std::string file = growing(2);
  for (const char* format : {"webm", "gif", "MP4"}) {
    const std::string name = std::string("a.") + format;
    const ProgramRun run = boule_run(command(file, path(name), {"--frames", "0-1"}), honest());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(read(name), HasSubstr("-f " + boule::ascii_lower(std::string_view(format)) + "\n"));
  }
}

TEST_F(Movies, NeedFfmpeg) {
  const ProgramRun run =
      refused_run(command(growing(2), path("a.mp4")), 1, {"PATH=" + path("nowhere")});
  EXPECT_THAT(run.err, AllOf(HasSubstr("ffmpeg, which is not in PATH"), HasSubstr("apt install")));
}

TEST_F(Movies, TellWhyFfmpegFailed) {
  const std::string file = growing(2);
  const auto early = with_ffmpeg("echo 'Unknown encoder libx264' >&2\nexit 1\n");
  EXPECT_THAT(refused_run(command(file, path("a.mp4")), 1, early).err,
              HasSubstr("cannot write '" + path("a.mp4") + "': ffmpeg: Unknown encoder libx264"));
  const auto late = with_ffmpeg("cat > /dev/null\necho 'no room' >&2\nexit 1\n");
  const auto before = files();
  const ProgramRun run = boule_run(command(file, path("a.mp4")), late);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("': ffmpeg: no room"));
  EXPECT_THAT(run.err, Not(HasSubstr("2 frames,"))) << "it tells of a movie that is not there";
  EXPECT_EQ(files(), before);
}

TEST_F(Movies, BrokenFramesLeaveNoMovie) {
  const std::string file = write("bad.xyz", "1\n\nC 0 0 0\n1\n\nC 0 zero 0\n");
  const auto environment = honest();
  const auto before = files();
  const ProgramRun run = boule_run(command(file, path("a.mp4")), environment);
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("bad.xyz:6:"));
  EXPECT_EQ(files(), before);
}

TEST_F(Movies, NeedFrames) {
  EXPECT_THAT(refused_run(command(water(), path("a.mp4")), 2).err,
              HasSubstr("a movie has many frames: --frames or --turn is missing"));
  EXPECT_THAT(refused_run(command(water(), path("a.png"), {"--fps", "5"}), 2).err,
              HasSubstr("is of movies"));
  EXPECT_THAT(refused_run(command(growing(2), path("a.mp4"), {"--format", "png"}), 2).err,
              HasSubstr("(key '--format')"));
}

TEST_F(Movies, TurntablesAreSeriesOfOneFile) {
  const std::string file = growing(1);
  ASSERT_EQ(boule_run(command(file, path("t.##.png"), {"--turn", "4"})).exit_code, 0);
  EXPECT_THAT(files(), testing::IsSupersetOf({"t.00.png", "t.01.png", "t.02.png", "t.03.png"}));
  EXPECT_FALSE(read("t.00.png") == read("t.01.png"));
  EXPECT_THAT(refused_run(command(file, path("t.png"), {"--turn", "4"}), 2).err,
              HasSubstr("with --frames or --turn the picture's name needs a place"));
  const auto both = command(file, path("t.##.png"), {"--turn", "4", "--frames", "0-3"});
  EXPECT_THAT(refused_run(both, 2).err, HasSubstr("makes a series of its own"));
  const ProgramRun movie = boule_run(command(file, path("t.gif"), {"--turn", "4"}), honest());
  EXPECT_EQ(movie.exit_code, 0) << movie.err;
  EXPECT_THAT(movie.err, HasSubstr("t.gif: 4 frames"));
}

TEST_F(Movies, PicturesTellTheirSizeInPrint) {
  std::vector<std::string> print = {"render", water(), "--quick", "--width",
                                    "5.08mm", "--dpi", "100"};
  const auto run_to = [&](const char* name) {
    std::vector<std::string> all = print;
    all.insert(all.end(), {"-o", path(name)});
    const ProgramRun run = boule_run(all);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr(": 20 x 15 pixels"));
    return read(name);
  };
  // 3937 pixels per metre, in PNG's chunk and in JFIF's header in inches.
  EXPECT_THAT(run_to("a.png"), HasSubstr(std::string("pHYs\0\0\x0f\x61\0\0\x0f\x61\x01", 13)));
  EXPECT_THAT(run_to("a.jpg"), HasSubstr(std::string("JFIF\0\x01\x01\x01\0\x64\0\x64", 12)));
  ASSERT_EQ(boule_run(command(water(), path("b.png"))).exit_code, 0);
  EXPECT_THAT(read("b.png"), Not(HasSubstr("pHYs")));
  print[4] = "900cm";
  print[6] = "3000";
  print.insert(print.end(), {"-o", path("c.png")});
  EXPECT_THAT(refused_run(print, 2).err,
              HasSubstr("must be 1 to 65535, is 1062992 (key '--width')"));
}

}  // namespace
}  // namespace boule::test
