// --checkpoint and --resume: runs that are ended and go on.
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/render/apps/cli/parts/part_program.h"
#include "tests/render/apps/cli/running_program.h"

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

TEST_F(CheckpointRuns, LeavesTheSamePictureAndNoFile) {
  const std::string whole = whole_picture();
  for (const char* interval : {"1ms", "60s"}) {
    const ProgramRun run =
        boule_run(render("out.exr", {"--checkpoint", path("run.film") + "," + interval}));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read("out.exr"), whole);
    EXPECT_THAT(files(), ElementsAre("out.exr", "scene.toml", "whole.exr"));
  }
}

TEST_F(CheckpointRuns, ResumesANoiseTarget) {
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

TEST_F(CheckpointRuns, ExistingCheckpointNeedsResume) {
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
  EXPECT_THAT(refused("99999", {"--max-depth", "3"}),
              HasSubstr("run.film: error: has --max-depth 5, not 3"));
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

TEST_F(CheckpointRuns, LockRefusesASecondRun) {
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

TEST_F(CheckpointRuns, ConflictingOptionsAreRefused) {
  EXPECT_THAT(refused_run(render("a.exr", {"--resume"}), 2).err, HasSubstr("needs --checkpoint"));
  EXPECT_THAT(refused_run(render("a.exr", {"--checkpoint", ",60s"}), 2).err,
              HasSubstr("expected FILE or FILE,TIME"));
  EXPECT_THAT(
      refused_run(render("a.##.exr", {"--frames", "1-2", "--checkpoint", path("c")}), 2).err,
      HasSubstr("needs a place for the number"));
}

/// A picture that is stopped although it is shown.
class ShownRuns : public CheckpointRuns {
 protected:
  /// Stopped as soon as there is something to show: after few of these samples.
  ProgramRun stopped_early(const std::vector<std::string>& words) const {
    ProgramRun run;
    for (int limit_ms = 2; limit_ms < 60'000; limit_ms *= 2) {
      for (const char* name : {"run.film", "out.exr"}) std::filesystem::remove(path(name));
      std::vector<std::string> limited = words;
      limited.insert(limited.end(), {"--time-limit", std::to_string(limit_ms) + "ms"});
      run = boule_run(limited);
      if (run.exit_code == 0) break;
    }
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run;
  }
  std::vector<std::string> shown(const std::string& spp, const std::vector<std::string>& more = {},
                                 const std::string& output = "out.exr") const {
    std::vector<std::string> words = {"--checkpoint", path("run.film")};
    words.insert(words.end(), more.begin(), more.end());
    return render(output, words, spp);
  }
};

TEST_F(ShownRuns, MatchesTheCheckpointThenTheWholeRun) {
  const std::string whole = whole_picture();
  for (const char* const order : {"rows", "tiles", "progressive", "frameless"}) {
    const ProgramRun run = stopped_early(shown("100000", {"--partial", "--order", order}));
    EXPECT_THAT(run.err, HasSubstr("out.exr: partial, "));
    EXPECT_THAT(run.err, HasSubstr("stopped by the time limit; "));
    EXPECT_THAT(run.err, HasSubstr("run.film holds them, --resume goes on\n"));
    const ProgramRun merged = boule_run({"merge", path("run.film"), "-o", path("now.exr"), "-q"});
    EXPECT_EQ(merged.exit_code, 0) << merged.err;
    EXPECT_THAT(merged.err, HasSubstr("now.exr: partial, "));
    EXPECT_EQ(read("now.exr"), read("out.exr")) << order;
    // Block by block, a pixel may have thousands of samples already.
    if (std::string(order) == "rows" || std::string(order) == "tiles") continue;
    const ProgramRun resumed = boule_run(shown("20", {"--partial", "--order", order, "--resume"}));
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(read("out.exr"), whole) << order;
    EXPECT_FALSE(std::filesystem::exists(path("run.film")));
  }
}

/// What was begun to be shown goes on without, and the other way round.
TEST_F(ShownRuns, AnyOtherRunGoesOn) {
  const std::string whole = whole_picture("400");
  const std::vector<std::string> partial = {"--partial"}, none;
  for (const auto* const first : {&partial, &none}) {
    std::vector<std::string> words = shown("400", *first);
    if (first == &none) {
      RunningProgram program(shown("400", none));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      program.send(SIGTERM);
      program.finish();
    } else {
      stopped_early(words);
    }
    std::vector<std::string> more = first == &partial ? none : partial;
    more.emplace_back("--resume");
    const ProgramRun run = boule_run(shown("400", more));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read("out.exr"), whole);
  }
}

TEST_F(ShownRuns, ASignalWritesThePictureToo) {
  RunningProgram program(long_run({"--partial"}));
  while (!std::filesystem::exists(path("run.film")))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.send(SIGTERM);
  EXPECT_EQ(program.finish().exit_code, 143);
  EXPECT_THAT(files(), ElementsAre("out.exr", "run.film", "scene.toml"));
}

TEST_F(ShownRuns, PicturesWhoseNoiseIsAskedForToo) {
  ASSERT_EQ(boule_run(render_noise("whole.exr")).exit_code, 0);
  const std::vector<std::string> saved = {"--checkpoint", path("run.film"), "--partial"};
  const ProgramRun stopped = stopped_early(render_noise("out.exr", saved));
  if (std::filesystem::exists(path("run.film"))) {  // finished where the machine is fast
    EXPECT_THAT(stopped.err, HasSubstr(" % of its pixels, stopped by the time limit; "));
    std::vector<std::string> more = render_noise("out.exr", saved);
    *std::find(more.begin(), more.end(), "64") = "128";
    more.emplace_back("--resume");
    EXPECT_THAT(refused_run(more, 3).err, HasSubstr("has --spp 64, not 128"));
  }
  std::vector<std::string> resumed = saved;
  resumed.emplace_back("--resume");
  const ProgramRun run = boule_run(render_noise("out.exr", resumed));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("out.exr"), read("whole.exr"));
}

TEST_F(ShownRuns, MoreSamplesMatchOneRun) {
  const std::string whole = whole_picture("20");
  const auto keep = [&](const std::string& spp) {
    std::filesystem::remove(path("run.film"));
    EXPECT_EQ(boule_run(render("run.film", {"--shard", "1/1"}, spp)).exit_code, 0);
  };
  // A sample that is the only one is none of several: then all begin anew.
  for (const char* const spp : {"1", "2", "7", "20"}) {
    keep(spp);
    const ProgramRun run = boule_run(shown("20", {"--resume"}));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read("out.exr"), whole) << spp;
    EXPECT_FALSE(std::filesystem::exists(path("run.film")));
  }
  keep("7");
  for (const auto& [spp, words] : {std::pair{"6", "expected --spp to be 7 or more, not 6"},
                                   std::pair{"1", "expected --spp to be 7 or more, not 1"}})
    EXPECT_THAT(refused_run(shown(spp, {"--resume"}), 3).err,
                HasSubstr(std::string("run.film: error: has pixels of 7 samples, ") + words));
}

/// The film of a share is its own checkpoint.
TEST_F(ShownRuns, AShardTakesMoreSamples) {
  const std::string whole = whole_picture("20");
  for (const char* const shard : {"1/2", "2/2"}) {
    const std::string film = std::string("part") + shard[0] + ".film";
    for (const char* const spp : {"4", "20"}) {
      const ProgramRun run =
          boule_run(render(film, {"--shard", shard, "--checkpoint", path(film), "--resume"}, spp));
      EXPECT_EQ(run.exit_code, 0) << run.err;
    }
  }
  const ProgramRun run =
      boule_run({"merge", path("part1.film"), path("part2.film"), "-o", path("merged.exr"), "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("merged.exr"), whole);
}

/// By hand with BOULE_KILLS=50. A run may end before its kill: then the next begins anew.
TEST_F(CheckpointRuns, KilledRunsGiveTheSamePicture) {
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
