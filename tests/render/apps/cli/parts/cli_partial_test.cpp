// Pictures that are ended early: whole files all the same, where that was asked for.
#include <csignal>

#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Partial : public ProgramTest {
 protected:
  static constexpr std::size_t pixel_count = 60'000;

  /// Takes days when nobody stops it.
  std::vector<std::string> long_run(const std::string& output,
                                    const std::vector<std::string>& options,
                                    const std::string& spp = "1000000000") const {
    std::vector<std::string> arguments = {"render", small_scene(), "-o",    path(output),
                                          "--size", "300x200",     "--spp", spp};
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

/// The limit is longer where it came before the first sample.
TEST_F(Partial, TimeLimitLeavesAWholePicture) {
  const auto render = [&](int limit_ms, const char* order, const char* quiet) {
    const std::string limit = std::to_string(limit_ms) + "ms";
    return boule_run(
        long_run("out.ppm", {"--time-limit", limit, "--partial", "--order", order, quiet}));
  };
  int limit_ms = 50;
  for (const char* order : {"rows", "tiles", "progressive", "frameless"}) {
    for (const char* quiet : {"-q", "--progress=none"}) {
      ProgramRun run = render(limit_ms, order, quiet);
      while (run.err.find("before the first sample") != std::string::npos && limit_ms < 60'000)
        run = render(limit_ms *= 2, order, quiet);
      EXPECT_EQ(run.exit_code, 0) << run.err;
      EXPECT_THAT(run.out, IsEmpty());
      EXPECT_THAT(run.err, HasSubstr("out.ppm: partial, "));
      EXPECT_THAT(run.err, EndsWith(" % of its samples, stopped by the time limit\n"));
      EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
      EXPECT_EQ(pixels("out.ppm", pixel_count).size(), 3 * pixel_count);
      EXPECT_THAT(files(), ElementsAre("out.ppm", "scene.toml"));
    }
  }
}

/// The place behind the first line of JSON that tells of a ten-thousandth: every pixel has samples.
std::size_t behind_first_samples(const std::string& shown, std::size_t from) {
  const std::string key = "{\"share\":";
  for (std::size_t at = from; (at = shown.find(key, at)) != std::string::npos;) {
    at += key.size();
    if (shown.find('\n', at) != std::string::npos && std::stod(shown.substr(at)) >= 1e-4) return at;
  }
  return std::string::npos;
}

/// Black pixels are those of the whole picture, about: what has no sample is filled.
TEST_F(Partial, ProgressiveIsDefaultAndLeavesNoHoles) {
  const auto black_pixels = [&] {
    const std::string bytes = pixels("out.ppm", pixel_count);
    int black = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      black += bytes[i] == 0 && bytes[i + 1] == 0 && bytes[i + 2] == 0 ? 1 : 0;
    }
    return black;
  };
  const ProgramRun whole =
      boule_run({"render", small_scene(), "-o", path("out.ppm"), "--size", "300x200", "-q"});
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  const int expected = black_pixels();
  EXPECT_LT(expected, 15'000);
  for (const char* order : {"", "--order=progressive", "--order=frameless"}) {
    std::vector<std::string> options = {"--partial", "--progress=json"};
    if (*order != '\0') options.emplace_back(order);
    RunningProgram program(long_run("out.ppm", options, "100000"));
    ASSERT_TRUE(program.wait_until(behind_first_samples));
    program.send(SIGINT);
    EXPECT_EQ(program.finish().exit_code, 130);
    EXPECT_NEAR(black_pixels(), expected, 1'500) << order;
  }
}

TEST_F(Partial, WithoutItATimeLimitWritesNothing) {
  const ProgramRun run = refused_run(long_run("out.ppm", {"--time-limit", "0.1s", "-q"}), 1);
  EXPECT_THAT(run.err, HasSubstr("time limit of 0.1 s"));
  EXPECT_THAT(run.err, HasSubstr("nothing written"));
}

TEST_F(Partial, NothingIsWrittenBeforeTheFirstSample) {
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

TEST_F(Partial, UninterruptedGivesTheSameFile) {
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

TEST_F(Partial, SecondSignalEndsAtOnce) {
  for (const auto& [signal, code, name] :
       {std::tuple{SIGINT, 130, "SIGINT"}, std::tuple{SIGTERM, 143, "SIGTERM"}}) {
    RunningProgram program(long_run("out.ppm", {"--partial"}));
    ASSERT_TRUE(program.wait_for("Mray/s"));
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_EQ(run.exit_code, code);
    EXPECT_THAT(run.out,
                EndsWith(" % of its samples, interrupted (" + std::string(name) + ")\r\n"));
    EXPECT_EQ(pixels("out.ppm", pixel_count).size(), 3 * pixel_count);
    EXPECT_THAT(files(), ElementsAre("out.ppm", "scene.toml"));
  }
  // WebP is packed in one call: the second signal comes then.
  RunningProgram program(long_run("out.webp", {"--partial"}), Hold{"write", path("")});
  ASSERT_TRUE(program.wait_for("Mray/s"));
  program.send(SIGINT);
  ASSERT_TRUE(program.wait_for_hold());
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
