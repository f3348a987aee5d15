// Ranks that mpirun starts: the same bits for any number of them, and an end for all when one
// fails.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <thread>

#include "tests/render/apps/cli/parts/part_program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;

/// One of the MPIs that this build has a module for: its name and its launcher.
struct Mpi {
  std::string name, launcher;
};
void PrintTo(const Mpi& mpi, std::ostream* out) { *out << mpi.name; }

/// "NAME=LAUNCHER,..." as the build found them.
std::vector<Mpi> all_mpis() {
  std::vector<Mpi> all;
  const std::string text = BOULE_MPIRUNS;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string one = text.substr(at, end - at);
    all.push_back({one.substr(0, one.find('=')), one.substr(one.find('=') + 1)});
    at = end + 1;
  }
  return all;
}

class MpiTest : public PartTest, public testing::WithParamInterface<Mpi> {
 protected:
  /// What OpenMPI asks of root, and of a machine with fewer cores than ranks.
  static std::vector<std::string> environment() {
    return {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
            "OMPI_MCA_rmaps_base_oversubscribe=1", "OMPI_MCA_btl_vader_single_copy_mechanism=none"};
  }
  /// `-n N boule ...`.
  static std::vector<std::string> ranks(int n, const std::vector<std::string>& command) {
    std::vector<std::string> words = {"-n", std::to_string(n), BOULE_PROGRAM};
    words.insert(words.end(), command.begin(), command.end());
    return words;
  }
  ProgramRun mpirun(const std::vector<std::string>& words) const {
    return run_program(GetParam().launcher, {words, environment()});
  }
  /// A picture that takes hours, with a checkpoint.
  std::vector<std::string> long_picture(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"--checkpoint", path("run.film") + ",20ms", "-t", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return render("long.exr", words, "100000");
  }
};

/// mpirun in the background.
class Launch {
 public:
  Launch(const Mpi& mpi, std::vector<std::string> words, const std::vector<std::string>& variables,
         std::string output)
      : output_(std::move(output)) {
    words.insert(words.begin(), mpi.launcher);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    for (const std::string& one : variables) {
      const std::size_t equals = one.find('=');
      ::setenv(one.substr(0, equals).c_str(), one.substr(equals + 1).c_str(), 1);
    }
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, output_.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    EXPECT_EQ(posix_spawn(&process_, argv[0], &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
  }
  Launch(const Launch&) = delete;
  Launch& operator=(const Launch&) = delete;

  /// The processes of the ranks, by the picture that they render; finish() waits for them.
  const std::vector<pid_t>& ranks(const std::string& picture) {
    ranks_.clear();
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      const std::string line = read_bytes(entry.path() / "cmdline");
      if (line.starts_with(BOULE_PROGRAM) && line.find(picture) != std::string::npos)
        ranks_.push_back(std::stoi(name));
    }
    return ranks_;
  }
  /// The exit code, and all that was told, when every rank has closed its files: the launcher may
  /// end first.
  ProgramRun finish() {
    int status = 0;
    waitpid(process_, &status, 0);
    for (const pid_t rank : ranks_)
      while (runs(rank)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_bytes(output_),
            ""};
  }

 private:
  /// A process that ends loses its command line first, and its files, with the locks on them,
  /// later: when the last of its threads becomes a zombie.
  static bool runs(pid_t process) {
    std::error_code gone;
    const std::string threads = "/proc/" + std::to_string(process) + "/task";
    std::filesystem::directory_iterator thread(threads, gone);
    for (; !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) {
      const std::string stat = read_bytes(thread->path() / "stat");
      const std::size_t state = stat.rfind(") ");
      if (state != std::string::npos && stat[state + 2] != 'Z' && stat[state + 2] != 'X')
        return true;
    }
    return false;
  }

  std::string output_;
  pid_t process_ = -1;
  std::vector<pid_t> ranks_;
};

void wait_for_file(const std::string& path) {
  while (!std::filesystem::exists(path)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

TEST_P(MpiTest, AllRankCountsGiveTheSamePicture) {
  const std::string whole = whole_picture();
  for (const int n : {1, 2, 3, 4, 7}) {
    const ProgramRun run = mpirun(ranks(n, render("out.exr", {"-t", std::to_string(n % 2 + 1)})));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read("out.exr"), whole) << n;
    std::filesystem::remove(path("out.exr"));
  }
}

TEST_P(MpiTest, NoiseTargetGivesTheSamePictureToo) {
  ASSERT_EQ(boule_run(render_noise("whole.exr")).exit_code, 0);
  const ProgramRun run = mpirun(ranks(3, render_noise("a.exr")));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("a.exr"), read("whole.exr"));
}

TEST_P(MpiTest, BondsGiveTheSamePictureToo) {
  ASSERT_EQ(boule_run(render_bonds("whole.exr")).exit_code, 0);
  const ProgramRun run = mpirun(ranks(3, render_bonds("a.exr", {"-t", "1"})));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("a.exr"), read("whole.exr"));
}

TEST_P(MpiTest, AShardToo) {
  const ProgramRun run = mpirun(ranks(3, render("a.film", {"--shard", "1/2", "-t", "1"})));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const ProgramRun alone = boule_run(render("b.film", {"--shard", "1/2"}));
  EXPECT_EQ(read("a.film"), read("b.film"));
}

/// By frames where there are enough of them, else frame by frame together.
TEST_P(MpiTest, SeriesMatchesOneProcess) {
  const std::string scene = small_scene();
  const auto series = [&](const std::string& frames, const std::string& folder) {
    std::filesystem::create_directory(path(folder));
    return std::vector<std::string>{
        "render", scene, "-o", path(folder + "/f.##.ppm"), "--frames", frames, "-q", "-t", "1"};
  };
  ASSERT_EQ(boule_run(series("1-9", "alone")).exit_code, 0);
  for (const char* const frames : {"1-9", "1-2"}) {
    const std::string folder = std::string("by") + frames;
    const ProgramRun run = mpirun(ranks(3, series(frames, folder)));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const int last = frames[2] - '0';
    for (int i = 1; i <= last; ++i) {
      const std::string name = "/f.0" + std::to_string(i) + ".ppm";
      EXPECT_EQ(read(folder + name), read("alone" + name));
    }
  }
}

TEST_P(MpiTest, RankWithOtherInputIsNamed) {
  const std::string scene = small_scene(), text = read("scene.toml");
  const std::string other = write("other.toml", text.substr(0, text.rfind("[[plane]]")));
  const auto both = [&](const std::vector<std::string>& odd) {
    std::vector<std::string> words =
        ranks(1, {"render", scene, "-o", path("a.ppm"), "-q", "--spp", "3"});
    words.emplace_back(":");
    const auto more = ranks(1, odd);
    words.insert(words.end(), more.begin(), more.end());
    const ProgramRun run = mpirun(words);
    EXPECT_NE(run.exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(path("a.ppm")));
    return run.out + run.err;
  };
  EXPECT_THAT(both({"render", scene, "-o", path("a.ppm"), "-q", "--spp", "4"}),
              testing::ContainsRegex("rank 1 .*has --spp 4, not 3"));
  EXPECT_THAT(both({"render", other, "-o", path("a.ppm"), "-q", "--spp", "3"}),
              testing::ContainsRegex("rank 1 .*is of another scene: hash "));
  EXPECT_THAT(both({"render", path("none.toml"), "-o", path("a.ppm"), "-q", "--spp", "3"}),
              testing::ContainsRegex("rank 1 .*failed: .*none.toml"));
}

TEST_P(MpiTest, ErrorOfAllRanksIsToldOnce) {
  const ProgramRun run = mpirun(ranks(3, {"render", path("none.toml"), "-o", path("a.ppm")}));
  EXPECT_EQ(run.exit_code, 3);
  const std::string told = run.out + run.err, line = "none.toml: error: cannot read it";
  const std::size_t first = told.find(line);
  ASSERT_NE(first, std::string::npos) << told;
  EXPECT_EQ(told.find(line, first + 1), std::string::npos) << told;
}

TEST_P(MpiTest, AFullDiskEndsAll) {
  std::filesystem::create_symlink("/dev/full", path("full.ppm"));
  const ProgramRun run =
      mpirun(ranks(3, {"render", small_scene(), "-o", path("full.ppm"), "-q", "-t", "1"}));
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.out + run.err, HasSubstr("No space left on device"));
}

/// The checkpoint is then one that any number of processes resumes from.
TEST_P(MpiTest, SignalToOneRankEndsAll) {
  Launch launch(GetParam(), ranks(3, long_picture()), environment(), path("told.txt"));
  wait_for_file(path("run.film"));
  const auto processes = launch.ranks(path("long.exr"));
  ASSERT_EQ(processes.size(), 3U);
  kill(processes.back(), SIGTERM);
  const ProgramRun run = launch.finish();
  EXPECT_EQ(run.exit_code, 143) << run.out;
  EXPECT_THAT(run.out, HasSubstr("; --resume goes on"));
  const ProgramRun more = boule_run(long_picture({"--resume", "--time-limit", "50ms"}));
  EXPECT_THAT(more.err, HasSubstr("stopped by the time limit, "));
}

/// MPICH's launcher ends all ranks by itself, at once.
TEST_P(MpiTest, KilledRankIsNamedAndCheckpointGood) {
  Launch launch(GetParam(), ranks(3, long_picture()), environment(), path("told.txt"));
  wait_for_file(path("run.film"));
  kill(launch.ranks(path("long.exr")).back(), SIGKILL);
  const ProgramRun run = launch.finish();
  EXPECT_NE(run.exit_code, 0);
  if (GetParam().name == "openmpi") {
    EXPECT_THAT(run.out, testing::ContainsRegex("rank [0-2] "));
  }
  const ProgramRun more = boule_run(long_picture({"--resume", "--time-limit", "50ms"}));
  EXPECT_THAT(more.err, HasSubstr("stopped by the time limit, "));
}

/// It takes the eight seconds after which a rank counts as lost.
TEST_P(MpiTest, AHangingRankIsNamed) {
  Launch launch(GetParam(), ranks(3, long_picture()), environment(), path("told.txt"));
  wait_for_file(path("run.film"));
  kill(launch.ranks(path("long.exr")).back(), SIGSTOP);
  const ProgramRun run = launch.finish();
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.out, testing::ContainsRegex(
                           "boule: error: rank [0-2] .*has given no sign of life for [0-9]+ s"));
  const ProgramRun more = boule_run(long_picture({"--resume", "--time-limit", "50ms"}));
  EXPECT_THAT(more.err, HasSubstr("stopped by the time limit, "));
}

TEST_P(MpiTest, NeverMeansAlone) {
  const ProgramRun run =
      mpirun(ranks(2, {"render", small_scene(), "-o", path("a.ppm"), "-t", "1", "--mpi", "never"}));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out + run.err, testing::Not(HasSubstr("2 ranks")));
}

INSTANTIATE_TEST_SUITE_P(Each, MpiTest, testing::ValuesIn(all_mpis()),
                         [](const auto& each) { return each.param.name; });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MpiTest);

TEST(Mpi, IsTestedWhereTheBuildFoundOne) {
  if (all_mpis().empty()) GTEST_SKIP() << "no MPI is installed: no ranks work together";
}

}  // namespace
}  // namespace boule::test
