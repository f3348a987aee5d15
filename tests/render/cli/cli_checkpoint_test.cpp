// --checkpoint and --resume: runs that are ended and go on.
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/render/cli/part_program.h"
#include "tests/render/cli/running_program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class CheckpointRuns : public PartTest {
 protected:
  std::vector<std::string> long_run(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"--checkpoint", path("run.film") + ",20ms"};
    words.insert(words.end(), more.begin(), more.end());
    return render("out.exr", words, "100000");
  }
  /// Runs until there is a checkpoint, then sends the signal.
  ProgramRun stopped_run(int signal) const {
    RunningProgram program(long_run());
    while (!std::filesystem::exists(path("run.film")))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.send(signal);
    return program.finish();
  }
};

TEST_F(CheckpointRuns, APictureIsThatOfARunWithoutAndNothingIsLeft) {
  const std::string whole = whole_picture();
  for (const char* interval : {"1ms", "60s"}) {
    const ProgramRun run =
        boule_run(render("out.exr", {"--checkpoint", path("run.film") + "," + interval}));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read("out.exr"), whole);
    EXPECT_THAT(files(), ElementsAre("out.exr", "scene.toml", "whole.exr"));
  }
}

TEST_F(CheckpointRuns, APictureWhoseNoiseIsAskedForGoesOnToo) {
  ASSERT_EQ(boule_run(render_noise("whole.exr")).exit_code, 0);
  const std::vector<std::string> saved = {"--checkpoint", path("run.film"), "--resume"};
  std::vector<std::string> stopped = saved;
  stopped.insert(stopped.end(), {"--time-limit", "1ms"});
  boule_run(render_noise("out.exr", stopped));  // finished where the machine is fast
  const ProgramRun run = boule_run(render_noise("out.exr", saved));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("out.exr"), read("whole.exr"));
}

TEST_F(CheckpointRuns, TheFirstSignalSavesAndSaysSo) {
  for (const int signal : {SIGTERM, SIGINT}) {
    const ProgramRun run = stopped_run(signal);
    EXPECT_EQ(run.exit_code, 128 + signal) << run.out;
    EXPECT_THAT(run.out, HasSubstr("run.film holds "));
    EXPECT_THAT(run.out, HasSubstr(" % of the samples; --resume goes on"));
    EXPECT_THAT(files(), ElementsAre("run.film", "scene.toml"));
    std::filesystem::remove(path("run.film"));
  }
}

TEST_F(CheckpointRuns, ATimeLimitSavesToo) {
  const ProgramRun run = boule_run(long_run({"--time-limit", "200ms"}));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("stopped by the time limit"));
  EXPECT_THAT(files(), ElementsAre("run.film", "scene.toml"));
}

TEST_F(CheckpointRuns, WhatIsThereIsNotReplacedWithoutResume) {
  stopped_run(SIGTERM);
  const std::string before = read("run.film");
  const ProgramRun run = refused_run(long_run(), 2);
  EXPECT_THAT(run.err, HasSubstr("--resume goes on from it"));
  EXPECT_EQ(read("run.film"), before);
}

TEST_F(CheckpointRuns, ResumeBeginsWhereThereIsNothingYet) {
  const std::string whole = whole_picture();
  const ProgramRun run =
      boule_run(render("out.exr", {"--checkpoint", path("run.film"), "--resume"}));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("out.exr"), whole);
}

TEST_F(CheckpointRuns, AnotherPictureIsRefusedByName) {
  stopped_run(SIGTERM);
  const auto refused = [&](const std::string& spp, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"--checkpoint", path("run.film"), "--resume"};
    words.insert(words.end(), more.begin(), more.end());
    return refused_run(render("out.exr", words, spp), 3).err;
  };
  EXPECT_THAT(refused("99999", {}), HasSubstr("run.film: error: has --spp 100000, not 99999"));
  EXPECT_THAT(refused("100000", {"--crop", "0,0,9,9"}), HasSubstr("has --crop 0,0,97,61, not"));
  const std::string scene = read("scene.toml");
  std::vector<std::string> other = long_run({"--resume"});
  other[1] = write("other.toml", scene.substr(0, scene.rfind("[[plane]]")));
  EXPECT_THAT(refused_run(other, 3).err, HasSubstr("is of another scene: hash "));
}

TEST_F(CheckpointRuns, ADamagedOneIsRefused) {
  stopped_run(SIGTERM);
  const std::string bytes = read("run.film");
  write("run.film", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(refused_run(long_run({"--resume"}), 3).err, HasSubstr("is cut off"));
  std::string changed = bytes;
  changed[bytes.size() / 2] = static_cast<char>(changed[bytes.size() / 2] ^ 1);
  write("run.film", changed);
  EXPECT_THAT(refused_run(long_run({"--resume"}), 3).err, HasSubstr("was changed"));
}

TEST_F(CheckpointRuns, TheSecondOfTwoIsRefusedByTheLock) {
  RunningProgram first(long_run());
  while (!std::filesystem::exists(path("run.film")))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const ProgramRun second = boule_run(long_run({"--resume"}));
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_THAT(second.err, HasSubstr("run.film.lock' is held by process "));
  first.send(SIGKILL);
  first.finish();
  const ProgramRun third = boule_run(long_run({"--resume", "--time-limit", "50ms"}));
  EXPECT_THAT(third.err, Not(HasSubstr("is held")));
}

TEST_F(CheckpointRuns, OptionsThatDoNotGoTogetherAreRefused) {
  EXPECT_THAT(refused_run(render("a.exr", {"--resume"}), 2).err, HasSubstr("needs --checkpoint"));
  const std::vector<std::string> partial = {"--checkpoint", path("c"), "--partial"};
  EXPECT_THAT(refused_run(render("a.exr", partial), 2).err, HasSubstr("--partial"));
  EXPECT_THAT(refused_run(render("a.exr", {"--checkpoint", ",60s"}), 2).err,
              HasSubstr("expected FILE or FILE,TIME"));
  EXPECT_THAT(
      refused_run(render("a.##.exr", {"--frames", "1-2", "--checkpoint", path("c")}), 2).err,
      HasSubstr("needs a place for the number"));
}

/// By hand with BOULE_KILLS=50. A run may end before its kill: then the next begins anew.
TEST_F(CheckpointRuns, KilledAtAnyTimeThePictureIsTheSame) {
  const char* const wanted = std::getenv("BOULE_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : 6;
  const std::string spp = "400", whole = whole_picture(spp);
  const std::vector<std::string> words =
      render("out.exr", {"--checkpoint", path("run.film") + ",10ms", "--resume"}, spp);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> delay(0, 150);
  for (int i = 0; i < kills; ++i) {
    RunningProgram program(words);
    std::this_thread::sleep_for(std::chrono::milliseconds(delay(random)));
    program.send(SIGKILL);
    const int code = program.finish().exit_code;
    EXPECT_TRUE(code == 128 + SIGKILL || code == 0) << code;
    if (code == 0) {
      EXPECT_EQ(read("out.exr"), whole);
    }
  }
  const ProgramRun run = boule_run(words);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("out.exr"), whole);
  std::vector<std::string> expected = {"out.exr", "scene.toml", "whole.exr"};
  EXPECT_EQ(files(), expected);
}

}  // namespace
}  // namespace boule::test
