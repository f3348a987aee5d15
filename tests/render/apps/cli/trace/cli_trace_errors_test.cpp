// What goes wrong with a trace, and signals: one clear line, the right exit code, nothing left.
#include <sys/stat.h>

#include <csignal>
#include <tuple>

#include "tests/render/apps/cli/running_program.h"
#include "tests/render/apps/cli/trace/trace_program.h"
#include "tests/render/image/files.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// What must be refused: exit code, one error, nothing new in the folder.
class TraceErrors : public Trace {
 protected:
  ProgramRun refused(const Arguments& arguments, int code) const {
    Arguments all = {"trace"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return refused_run(all, code);
  }
  /// The same for the rays at `rays`.
  ProgramRun refused_rays(const std::string& rays) const {
    return refused({path("scene.toml"), "--rays", rays, "-o", path("h.npy"), "-q"}, 3);
  }
};

TEST_F(TraceErrors, WrongUsage) {
  const std::string scene = small_scene(), rays = write("r.npy", ray_file(ray_cloud(3)));
  const std::string hits = path("h.npy");
  for (const Arguments& arguments :
       std::vector<Arguments>{{},
                              {scene},
                              {scene, "-o", hits},
                              {scene, "--rays", rays},
                              {"--rays", rays, "-o", hits},
                              {scene, "--rays", rays, "-o"},
                              {scene, "--rays", rays, "-o", hits, "more"},
                              {scene, "--rays", rays, "-o", hits, "--size", "3x3"},
                              {scene, "--rays", rays, "-o", hits, "--any-hit=perhaps"},
                              {scene, "--rays", rays, "-o", hits, "-q", "-v"},
                              {scene, "--rays", rays, "-o", hits, "--isa", "sse9"},
                              {scene, "--rays", rays, "-o", hits, "--solver", "exact"},
                              {scene, "--rays", rays, "-o", hits, "-t", "-1"},
                              {scene, "--rays", rays, "-o", hits, "--progress", "dots"},
                              {scene, "--rays", rays, "-o", hits, "--stats", "yaml"},
                              {scene, "--rays", rays, "-o", hits, "--stats", "json:" + hits}}) {
    EXPECT_THAT(refused(arguments, 2).err, StartsWith("boule: error: "));
  }
  // Told before anything is read.
  for (const char* name : {"h", "h.", "h.txt", "h.npz", "npy", ".npy", "-", "h.npy/"}) {
    const ProgramRun run = refused({"none.toml", "--rays", "none.npy", "-o", name}, 2);
    EXPECT_THAT(run.err, HasSubstr("(key '--output')"));
  }
}

TEST_F(TraceErrors, ABadSceneIsInvalidInput) {
  const std::string rays = write("r.npy", ray_file(ray_cloud(3)));
  const std::string scene = write("bad.toml", "schema = 1\n[[sphere]]\nradius = -1\n");
  EXPECT_THAT(refused({scene, "--rays", rays, "-o", path("h.npy")}, 3).err,
              StartsWith(scene + ":3:10: error: "));
  for (const char* name : {"none.toml", "none"}) {
    EXPECT_THAT(refused({path(name), "--rays", rays, "-o", path("h.npy")}, 3).err,
                HasSubstr("No such file or directory"));
  }
}

TEST_F(TraceErrors, BadRaysNameWhatWasExpected) {
  small_scene();
  const std::string row = ray_rows(ray_cloud(1));
  const auto file = [&](const std::string& descr, const std::string& shape,
                        const std::string& order = "False") {
    return npy_file(npy_dict(descr, shape, order), row);
  };
  const std::string good = file("'<f4'", "(1, 8)");
  const std::tuple<std::string, std::string> cases[] = {
      {"", "not a readable .npy file: it does not begin with \\x93NUMPY"},
      {"rays, surely", "not a readable .npy file: it does not begin with \\x93NUMPY"},
      {npy_file(npy_dict("'<f4'", "(1, 8)"), row, 4),
       "not a readable .npy file: its format version is 4.0, expected 1.0, 2.0 or 3.0"},
      {good.substr(0, 9), "not a readable .npy file: it ends within its header"},
      {good.substr(0, 60), "not a readable .npy file: it ends within its header"},
      {npy_file("(1, 8)", row), "not a readable .npy file: its header is no dict"},
      {file("'<f8'", "(1, 8)"), "declares 1 rows of 64 bytes, but holds 32 bytes of data"},
      {file("'>f4'", "(1, 8)"),
       "holds '>f4', expected '<f4' or '<f8' (little-endian float32 or float64)"},
      {file("'<i4'", "(1, 8)"),
       "holds '<i4', expected '<f4' or '<f8' (little-endian float32 or float64)"},
      {file("[('t', '<f8')]", "(1,)"), "has named fields, expected rows of numbers"},
      {file("[('t', )]", "(1,)"),
       "not a readable .npy file: header key 'descr' has an unexpected value"},
      {file("'<f4'", "(1, 8)", "True"), "is in Fortran order, expected C order (row by row)"},
      {file("'<f4'", "(8,)"),
       "has shape (8), expected (N, 8): origin, tmin, direction, tmax; or (N, 10): source and "
       "inside, too"},
      {file("'<f4'", "(8, 1)"),
       "has shape (8, 1), expected (N, 8): origin, tmin, direction, tmax; or (N, 10): source and "
       "inside, too"},
      {file("'<f4'", "(1, 1, 8)"),
       "has shape (1, 1, 8), expected (N, 8): origin, tmin, direction, tmax; or (N, 10): source "
       "and inside, too"},
      {file("'<f4'", "(2, 8)"), "declares 2 rows of 32 bytes, but holds 32 bytes of data"},
      {file("'<f4'", "(0, 8)"), "declares 0 rows of 32 bytes, but holds 32 bytes of data"},
      {file("'<f4'", "(576460752303423489, 8)"),
       "declares 576460752303423489 rows of 32 bytes, but holds 32 bytes of data"},
      {good.substr(0, good.size() - 1), "declares 1 rows of 32 bytes, but holds 31 bytes of data"},
      {good + "x", "declares 1 rows of 32 bytes, but holds 33 bytes of data"}};
  for (const auto& [bytes, words] : cases) {
    const std::string rays = write("r.npy", bytes);
    EXPECT_EQ(refused_rays(rays).err, rays + ": error: " + words + "\n");
  }
}

TEST_F(TraceErrors, OnlyRegularFilesAreReadAsRays) {
  small_scene();
  const auto reads = [&](const std::string& rays, const std::string& reason) {
    EXPECT_EQ(refused_rays(rays).err, rays + ": error: cannot read it: " + reason + "\n");
  };
  reads(path("none.npy"), "No such file or directory");
  std::filesystem::create_directory(path("folder.npy"));
  reads(path("folder.npy"), "it is a directory, expected a regular file");
  ASSERT_EQ(mkfifo(path("fifo.npy").c_str(), 0600), 0);
  reads(path("fifo.npy"), "it is a FIFO, expected a regular file");
  reads("/dev/zero", "it is a device, expected a regular file");
}

TEST_F(TraceErrors, UnwritableOutputGivesTheSystemsReason) {
  const std::string scene = small_scene(), rays = write("r.npy", ray_file(ray_cloud(3)));
  const auto reason = [&](const std::string& name) {
    return refused({scene, "--rays", rays, "-o", name, "-q"}, 1).err;
  };
  EXPECT_EQ(reason(path("no/h.npy")),
            "boule: error: cannot write '" + path("no/h.npy") + "': No such file or directory\n");
  std::filesystem::create_directory(path("folder.npy"));
  EXPECT_THAT(reason(path("folder.npy")), HasSubstr("Is a directory"));
  std::filesystem::create_symlink("/dev/full", path("full.npy"));
  EXPECT_THAT(reason(path("full.npy")), HasSubstr("No space left on device"));
}

TEST_F(TraceErrors, AFullDiskKeepsTheOldFile) {
  const std::string scene = small_scene(), rays = write("r.npy", ray_file(ray_cloud(300'000)));
  const std::string target = write("h.npy", "old");
  const FileSizeLimit limit(1 << 20);
  EXPECT_EQ(refused({scene, "--rays", rays, "-o", target, "-q"}, 1).err,
            "boule: error: cannot write '" + target + "': File too large\n");
  EXPECT_EQ(read("h.npy"), "old");
}

class TraceSignals : public Trace {};

/// Before its header is written, which a signal waits for, and before its first hits are.
TEST_F(TraceSignals, SignalEndsItAndLeavesNothing) {
  const std::string scene = cloud_scene(100);
  const std::string rays = write("r.npy", ray_file(ray_cloud(1000)));
  const std::tuple<int, int, const char*> signals[] = {
      {SIGINT, 130, "SIGINT"}, {SIGTERM, 143, "SIGTERM"}, {SIGHUP, 129, "SIGHUP"}};
  for (const auto& [signal, code, name] : signals) {
    for (const int number : {1, 2}) {
      RunningProgram program(
          {"trace", scene, "--rays", rays, "-o", path("h.npy"), "--progress", "none"},
          Hold{"write", path(""), number});
      ASSERT_TRUE(program.wait_for_hold());
      program.send(signal);
      if (number == 1) program.let_go();
      const ProgramRun run = program.finish();
      EXPECT_EQ(run.exit_code, code);
      EXPECT_EQ(run.out, std::string("boule: interrupted (") + name + "), nothing written\r\n");
      EXPECT_THAT(files(), ElementsAre("cloud.npy", "cloud.toml", "r.npy"));
    }
  }
}

TEST_F(TraceSignals, ASignalEndsTheBarsLineFirst) {
  const std::string scene = cloud_scene(100);
  const std::string rays = write("r.npy", ray_file(ray_cloud(1000)));
  RunningProgram program({"trace", scene, "--rays", rays, "-o", path("h.npy")},
                         Hold{"say", "Mray/s"});
  ASSERT_TRUE(program.wait_for_hold());
  program.send(SIGTERM);
  const ProgramRun run = program.finish();
  EXPECT_EQ(run.exit_code, 143);
  EXPECT_THAT(run.out, EndsWith("\r\nboule: interrupted (SIGTERM), nothing written\r\n"));
  EXPECT_THAT(files(), ElementsAre("cloud.npy", "cloud.toml", "r.npy"));
}

/// It looks for the reader again and again.
TEST_F(TraceSignals, SignalEndsTheWaitForAReader) {
  const std::string scene = cloud_scene(3);
  write("r.npy", ray_file(ray_cloud(20'000)));
  ASSERT_EQ(mkfifo(path("h.npy").c_str(), 0600), 0);
  RunningProgram program(
      {"trace", scene, "--rays", path("r.npy"), "-o", path("h.npy"), "--progress", "none"},
      Hold{"open", path("h.npy"), 3});
  ASSERT_TRUE(program.wait_for_hold());
  program.send(SIGTERM);
  program.let_go();
  const ProgramRun run = program.finish();
  EXPECT_EQ(run.exit_code, 143);
  EXPECT_EQ(run.out, "boule: interrupted (SIGTERM), nothing written\r\n");
}

}  // namespace
}  // namespace boule::test
