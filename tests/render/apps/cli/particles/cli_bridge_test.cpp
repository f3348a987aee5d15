// Files of other programs: the program with a reader in place of Python, a script of the shell.
#include <signal.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "tests/render/apps/cli/particles/particles_fixture.h"

namespace boule::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The first answer of a reader.
constexpr const char* head = "printf 'boule-read 1\\nlibrary fake 2\\nframes 3\\n\\n'\n";

class Bridges : public ParticlesTest {
 protected:
  /// An environment whose Python is this script. It adds its number to the file "started".
  std::vector<std::string> with_reader(const std::string& script) const {
    write("reader", "#!/bin/sh\necho $$ >> " + path("started") + "\n" + script);
    chmod(path("reader").c_str(), 0755);
    return {"BOULE_PYTHON=" + path("reader")};
  }
  /// One whose files have three frames of a particle.
  std::vector<std::string> honest() const {
    return with_reader(
        std::string(head) +
        "while read line; do printf 'particles 1\\npositions\\n\\n'; head -c 24 /dev/zero; done\n");
  }
  std::string file() const { return write("run.xtc", "bytes"); }

  /// Waits until no process of those that were started runs. (Somebody else may have to bury it.)
  void wait_for_end() const {
    const std::string started = read("started");
    if (started.empty()) return;  // it was ended before it said its number
    const int process = std::stoi(started);
    const auto is_over = [&] {
      if (kill(process, 0) != 0 && errno == ESRCH) return true;
      const std::string state = read_bytes("/proc/" + std::to_string(process) + "/stat");
      return state.find(") Z ") != std::string::npos;
    };
    while (!is_over()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
};

TEST_F(Bridges, OwnFormatsStartNoPython) {
  const auto environment = with_reader("exit 1\n");
  EXPECT_EQ(boule_run({"info", water()}, environment).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("started")));
}

TEST_F(Bridges, SeriesKeepOneReader) {
  const std::string run_file = file();
  const ProgramRun run = boule_run({"render", run_file, "-o", path("a.#.ppm"), "--frames", "0-2",
                                    "--size", "8x6", "--quick", "--radius", "1"},
                                   honest());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(path("a.2.ppm")));
  EXPECT_THAT(run.err, HasSubstr("read by fake 2"));
  const std::string started = read("started");
  EXPECT_EQ(std::count(started.begin(), started.end(), '\n'), 1);
  wait_for_end();
}

TEST_F(Bridges, InfoTellsTheFrames) {
  const ProgramRun run = boule_run({"info", file()}, honest());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("library"), HasSubstr("3")));
}

TEST_F(Bridges, ErrorsAreOneLine) {
  const auto before = file();
  const ProgramRun run = boule_run({"render", before, "-o", path("a.ppm")},
                                   with_reader("echo noise >&2\nprintf 'error a %%: bad\\n\\n'\n"));
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("run.xtc: error: a %: bad"), Not(HasSubstr("noise"))));
  EXPECT_FALSE(std::filesystem::exists(path("a.ppm")));
}

TEST_F(Bridges, ReadersEndWithTheProgram) {
  for (const char* signal : {"TERM", "INT", "KILL"}) {
    std::filesystem::remove(path("started"));
    const auto environment =
        with_reader(std::string(head) + "read line\nkill -" + signal + " $PPID\nsleep 100000\n");
    EXPECT_NE(boule_run({"info", file()}, environment).exit_code, 0) << signal;
    wait_for_end();
  }
}

TEST_F(Bridges, LoadLimitEndsReadersThatHang) {
  const ProgramRun run = boule_run({"info", file(), "--load-limit", "200ms"},
                                   with_reader("while :; do sleep 1000; done\n"));
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("took longer than --load-limit 0.2 s"));
  if (std::filesystem::exists(path("started"))) wait_for_end();
}

}  // namespace
}  // namespace boule::test
