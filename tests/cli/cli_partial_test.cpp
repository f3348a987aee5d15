// Pictures that are ended early: whole files all the same, where that was asked for.
#include <csignal>

#include "tests/cli/program.h"
#include "tests/cli/running_program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Partial : public ProgramTest {
 protected:
  /// Takes minutes when nobody stops it.
  std::vector<std::string> long_run(const std::string& output,
                                    const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"render", small_scene(), "-o",    path(output),
                                          "--size", "1000x800",    "--spp", "5000"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  /// The pixels of a binary PPM file, after checking that all are there.
  std::string pixels(const std::string& name, std::size_t count) const {
    const std::string file = read(name);
    EXPECT_THAT(file, StartsWith("P6\n"));
    EXPECT_GT(file.size(), 3 * count);
    return file.substr(file.size() - std::min(file.size(), 3 * count));
  }
};

TEST_F(Partial, ATimeLimitLeavesAWholePictureAndSaysSoInOneLine) {
  for (const char* order : {"rows", "tiles", "progressive", "frameless"}) {
    for (const char* quiet : {"-q", "--progress=none"}) {
      const Watch watch;
      const ProgramRun run = boule_run(
          long_run("out.ppm", {"--time-limit", "500ms", "--partial", "--order", order, quiet}));
      EXPECT_LT(watch.seconds(), 10);
      EXPECT_EQ(run.exit_code, 0) << run.err;
      EXPECT_THAT(run.out, IsEmpty());
      EXPECT_THAT(run.err, HasSubstr("out.ppm: partial, "));
      EXPECT_THAT(run.err, EndsWith(" % of its samples, stopped by the time limit\n"));
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
      EXPECT_EQ(pixels("out.ppm", 800'000).size(), 2'400'000u);
      EXPECT_THAT(files(), ElementsAre("out.ppm", "scene.toml"));
    }
  }
}

/// Black pixels are those of the whole picture, about: what has no sample is filled.
TEST_F(Partial, ProgressiveIsItsOwnDefaultAndLeavesNoHoles) {
  const auto black_pixels = [&] {
    const std::string bytes = pixels("out.ppm", 800'000);
    int black = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      black += bytes[i] == 0 && bytes[i + 1] == 0 && bytes[i + 2] == 0 ? 1 : 0;
    }
    return black;
  };
  const ProgramRun whole =
      boule_run({"render", small_scene(), "-o", path("out.ppm"), "--size", "1000x800", "-q"});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  const int expected = black_pixels();
  EXPECT_LT(expected, 200'000);
  for (const char* order : {"", "--order=progressive", "--order=frameless"}) {
    std::vector<std::string> options = {"--partial"};
    if (*order != '\0') options.emplace_back(order);
    RunningProgram program(long_run("out.ppm", options));
    ASSERT_TRUE(program.wait_for("Mray/s"));
    ASSERT_TRUE(program.wait_for_work(0.1));
    program.send(SIGINT);
    EXPECT_EQ(program.finish().exit_code, 130);
    EXPECT_NEAR(black_pixels(), expected, 20'000) << order;
  }
}

TEST_F(Partial, WithoutItATimeLimitWritesNothing) {
  const ProgramRun run = refused_run(long_run("out.ppm", {"--time-limit", "0.1s", "-q"}), 1);
  EXPECT_THAT(run.err, HasSubstr("time limit of 0.1 s"));
  EXPECT_THAT(run.err, HasSubstr("nothing written"));
}

TEST_F(Partial, BeforeTheFirstSampleThereIsNothingToWrite) {
  std::string text = "schema = 1\n[material.g]\ntype = \"glass\"\n";
  for (int i = 0; i < 60; ++i) {
    text += "[[sphere]]\nmaterial = \"g\"\nradius = " + std::to_string(i + 1) + "\n";
  }
  const std::string scene = write("deep.toml", text + "[render]\nmax_depth = 22\n");
  const ProgramRun run = refused_run({"render", scene, "-o", path("out.ppm"), "--size", "4000x4000",
                                      "-t", "1", "-q", "--partial", "--time-limit", "1ms"},
                                     1);
  EXPECT_THAT(run.err, HasSubstr("before the first sample, nothing written"));
}

TEST_F(Partial, NotEndedEarlyItIsTheSameFile) {
  const auto picture = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path("out.exr"),
                                          "-q",     "--spp",       "5"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(boule_run(arguments).exit_code, 0);
    return read("out.exr");
  };
  const std::string plain = picture({});
  for (const char* order : {"rows", "tiles", "progressive", "frameless"}) {
    EXPECT_EQ(picture({"--partial", "--order", order}), plain);
    EXPECT_EQ(picture({"--partial", "--time-limit", "1h", "--order", order}), plain);
    EXPECT_EQ(picture({"--time-limit", "10m", "--order", order}), plain);
  }
}

TEST_F(Partial, AFirstSignalWritesThePictureASecondEndsAtOnce) {
  for (const auto& [signal, code, name] :
       {std::tuple{SIGINT, 130, "SIGINT"}, std::tuple{SIGTERM, 143, "SIGTERM"}}) {
    RunningProgram program(long_run("out.ppm", {"--partial"}));
    ASSERT_TRUE(program.wait_for("Mray/s"));
    ASSERT_TRUE(program.wait_for_work(0.3));
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_EQ(run.exit_code, code);
    EXPECT_THAT(run.out,
                EndsWith(" % of its samples, interrupted (" + std::string(name) + ")\r\n"));
    EXPECT_EQ(pixels("out.ppm", 800'000).size(), 2'400'000u);
    EXPECT_THAT(files(), ElementsAre("out.ppm", "scene.toml"));
  }
  // WebP takes seconds to pack: the second signal comes then.
  RunningProgram program({"render", small_scene(), "-o", path("out.webp"), "--size", "8000x6000",
                          "--spp", "500", "--partial"});
  ASSERT_TRUE(program.wait_for("Mray/s"));
  ASSERT_TRUE(program.wait_for_work(1));
  program.send(SIGINT);
  ASSERT_TRUE(program.wait_for_output(path(""), 0));
  ASSERT_TRUE(program.wait_for_work(0.6));
  program.send(SIGINT);
  const ProgramRun run = program.finish();
  EXPECT_EQ(run.exit_code, 130);
  EXPECT_THAT(run.out, EndsWith("boule: interrupted (SIGINT), nothing written\r\n"));
  EXPECT_THAT(files(), ElementsAre("out.ppm", "scene.toml"));
}

TEST_F(Partial, WrongTimesAreRefused) {
  for (const char* time : {"0", "-1s", "s", "", "1d", "nan", "inf", "1e3", "1 s", "0ms", "2e9h"}) {
    const ProgramRun run =
        refused_run(long_run("out.ppm", {std::string("--time-limit=") + time}), 2);
    EXPECT_THAT(run.err, HasSubstr("--time-limit")) << time;
  }
}

}  // namespace
}  // namespace boule::test
