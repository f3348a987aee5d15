// --time-limit and --load-limit: a clock decides, whatever the parent process has done to signals
// and whatever a call of the system waits for.
#include <csignal>

#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

using testing::HasSubstr;

class TimeLimits : public ProgramTest {};

/// Rendering has no end of its own.
TEST_F(TimeLimits, CountAlsoWhereTheParentBlocksAlarms) {
  sigset_t alarm{}, before{};
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  pthread_sigmask(SIG_BLOCK, &alarm, &before);  // exec keeps it
  const ProgramRun run = boule_run({"render", small_scene(), "-o", path("o.ppm"), "--spp",
                                    "2000000000", "--time-limit", "50ms", "-q"});
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("the time limit of 0.05 s came first, nothing written"));
}

class LoadLimits : public ProgramTest {
 protected:
  /// The program is held in a call that reads, for good: the limit ends it all the same.
  void expect_ended(const std::vector<std::string>& arguments, const std::string& file,
                    const std::string& named) const {
    const auto before = files();
    std::vector<std::string> limited = arguments;
    limited.insert(limited.end(), {"--load-limit", "10ms"});
    RunningProgram program(limited, Hold{"read", file});
    const ProgramRun run = program.finish();
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_EQ(run.out.substr(0, 30), "boule: error: reading '/tmp/bo") << named;
    EXPECT_THAT(run.out, testing::EndsWith("' took longer than --load-limit 0.01 s\r\n"));
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1) << run.out;
    EXPECT_EQ(files(), before);
  }
};

TEST_F(LoadLimits, EndAReadThatDoesNotReturn) {
  const std::string scene = small_scene(), rays = path("rays.npy");
  write("rays.npy", npy_file(npy_dict("'<f4'", "(1, 8)"), std::string(32, '\0')));
  const std::string cloud = write("cloud.toml", "schema = 1\n[[spheres]]\nfile = \"c.npy\"\n");
  const std::string data =
      write("c.npy", npy_file(npy_dict("'<f4'", "(1, 4)"), std::string(16, 1)));
  expect_ended({"render", scene, "-o", path("o.png")}, scene, "scene");
  expect_ended({"render", cloud, "-o", path("o.png")}, data, "data");
  expect_ended({"render", scene, "-o", path("o#.png"), "--frames", "1-3"}, scene, "scene");
  expect_ended({"info", scene}, scene, "scene");
  expect_ended({"trace", scene, "--rays", rays, "-o", path("h.npy")}, scene, "scene");
  expect_ended({"trace", scene, "--rays", rays, "-o", path("h.npy")}, rays, "rays");
}

/// Any reading takes longer than a nanosecond, none that ends as long as eleven days.
TEST_F(LoadLimits, AreOfAllThatIsRead) {
  const std::string scene = small_scene();
  const ProgramRun run =
      refused_run({"render", scene, "-o", path("o.ppm"), "--load-limit", "0.000001ms"}, 1);
  EXPECT_THAT(run.err, HasSubstr("took longer than --load-limit 1e-09 s"));
  refused_run({"info", scene, "--load-limit", "0.000001ms"}, 1);
  for (const char* limit : {"277h", "1000000000s"}) {
    EXPECT_EQ(boule_run({"render", scene, "-o", path("o.ppm"), "--load-limit", limit}).exit_code,
              0);
  }
  for (const char* limit : {"0", "-1s", "", "nan", "1d"}) {
    refused_run({"info", scene, std::string("--load-limit=") + limit}, 2);
  }
}

}  // namespace
}  // namespace boule::test
