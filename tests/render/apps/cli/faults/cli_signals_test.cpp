// Signals: the program is gone at once, says so, and leaves nothing behind. It is held where the
// signal is to find it: what ends it there is the signal, not the end of its work.
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <tuple>

#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

const std::tuple<int, int, const char*> signals[] = {
    {SIGINT, 130, "SIGINT"}, {SIGTERM, 143, "SIGTERM"}, {SIGHUP, 129, "SIGHUP"}};

class Signals : public ProgramTest {
 protected:
  std::string message(const char* name, const char* end = "nothing written") const {
    return std::string("boule: interrupted (") + name + "), " + end + "\r\n";
  }
  std::vector<std::string> render(const std::string& output,
                                  const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path(output)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  /// Each of the signals ends the program while it is held there: what was said before the line
  /// that says so.
  std::vector<std::string> expect_ended(const std::vector<std::string>& arguments,
                                        const Hold& hold) const {
    const auto before = files();
    std::vector<std::string> told;
    for (const auto& [signal, code, name] : signals) {
      RunningProgram program(arguments, hold);
      EXPECT_TRUE(program.wait_for_hold());
      program.send(signal);
      const ProgramRun run = program.finish();
      EXPECT_EQ(run.exit_code, code);
      EXPECT_THAT(run.out, EndsWith(message(name)));
      EXPECT_EQ(files(), before);
      told.push_back(run.out.substr(0, run.out.size() - message(name).size()));
    }
    return told;
  }
};

TEST_F(Signals, WhileRenderingEndTheBarsLineFirst) {
  for (const std::string& told :
       expect_ended(render("out.png", {"--size", "200x200"}), {"say", "Mray/s"})) {
    EXPECT_THAT(told, EndsWith("\r\n"));
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  }
}

/// It looks for the reader again and again.
TEST_F(Signals, EndAFifoWithoutReader) {
  for (const char* name : {"out.png", "hits.npy"}) {
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
  }
  write("rays.npy", npy_file(npy_dict("'<f4'", "(0, 8)"), ""));
  const std::vector<std::string> trace = {"trace", small_scene(),    "--rays", path("rays.npy"),
                                          "-o",    path("hits.npy"), "-q"};
  for (const auto& arguments :
       {render("out.png", {"-q"}), render("out.png", {"-q", "--partial"}), trace}) {
    const std::string fifo = path(arguments[0] == "trace" ? "hits.npy" : "out.png");
    RunningProgram program(arguments, Hold{"open", fifo, 3});
    ASSERT_TRUE(program.wait_for_hold());
    program.send(SIGTERM);
    program.let_go();
    const ProgramRun run = program.finish();
    EXPECT_EQ(run.exit_code, 143);
    EXPECT_EQ(run.out, message("SIGTERM"));
  }
}

TEST_F(Signals, LinkToAPipeGetsThePicture) {
  ASSERT_EQ(boule_run(render("whole.png", {"-q"})).exit_code, 0);
  std::filesystem::create_symlink("/dev/stdout", path("stdout.png"));
  const std::string line = "cd " + path("") +
                           "; \"" BOULE_PROGRAM
                           "\" render scene.toml -q -o stdout.png | cat > copy.png";
  EXPECT_EQ(run_program("/bin/sh", {{"-c", line}, {}}).err, "");
  EXPECT_TRUE(read("copy.png") == read("whole.png"));
}

TEST_F(Signals, LateReaderGetsThePicture) {
  ASSERT_EQ(boule_run(render("whole.png", {"-q"})).exit_code, 0);
  ASSERT_EQ(mkfifo(path("fifo.png").c_str(), 0600), 0);
  RunningProgram program(render("fifo.png", {"-q"}), Hold{"open", path("fifo.png"), 3});
  ASSERT_TRUE(program.wait_for_hold());
  program.let_go();
  EXPECT_TRUE(run_program("/bin/cat", {{path("fifo.png")}, {}}).out == read("whole.png"));
  EXPECT_EQ(program.finish().exit_code, 0);
}

TEST_F(Signals, WhileLoadingEndItAtOnce) {
  // More than is read at once; no note yet: it is still reading.
  const std::string scene =
      write("long.toml", "schema = 1\n" + std::string(std::size_t{1} << 20, '\n'));
  for (const int number : {1, 3}) {
    for (const std::string& told :
         expect_ended({"render", scene, "-o", path("out.png"), "-v", "--progress", "none"},
                      {"read", scene, number}))
      EXPECT_EQ(told, "");
  }
}

/// The scene was read, and threads that prepare it are being started: the note that ends this is
/// not there yet.
TEST_F(Signals, WhileBuildingEndItAtOnce) {
  constexpr std::uintmax_t spheres = 200'000;
  const std::string cloud = write("cloud.npy", npy_file(npy_dict("'<f4'", "(200000, 3)"), ""));
  std::filesystem::resize_file(cloud, read("cloud.npy").size() + spheres * 12);
  const std::string scene =
      write("cloud.toml", "schema = 1\n[[spheres]]\nfile = \"cloud.npy\"\nradius = 1\n");
  const std::string read_in = ", read in ";
  for (const std::string& told : expect_ended(
           {"render", scene, "-o", path("out.exr"), "-v", "-t", "3"}, {"thread", "", 1, read_in})) {
    EXPECT_THAT(told, HasSubstr(read_in));
    EXPECT_THAT(told, testing::Not(HasSubstr("prepared in")));
  }
}

/// WebP is packed in one call, which asks nobody: the handler itself ends it. A file with a name
/// must go: FaultsWithNames.ASignalRemovesTheFile.
TEST_F(Signals, WhileWritingLeaveNothing) {
  for (const char* name : {"out.exr", "out.webp"}) {
    for (const std::string& told :
         expect_ended(render(name, {"--progress", "none"}), {"write", path("")}))
      EXPECT_EQ(told, "");
  }
}

TEST_F(Signals, StopWaitingForASlowReader) {
  const std::string pipe = path("out.ppm");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto arguments = render("out.ppm", {"--size", "640x480", "--progress", "none"});
  for (const auto& [signal, code, name] : signals) {
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);  // and never reads
    RunningProgram program(arguments);
    const auto is_full = [&](const std::string&, std::size_t from) {
      int bytes = 0;
      ioctl(reader, FIONREAD, &bytes);
      return bytes == fcntl(reader, F_GETPIPE_SZ) ? from : std::string::npos;
    };
    ASSERT_TRUE(program.wait_until(is_full));
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_EQ(run.exit_code, code);
    EXPECT_THAT(run.out, EndsWith(message(name, "the output is incomplete")));
    close(reader);
  }
}

}  // namespace
}  // namespace boule::test
