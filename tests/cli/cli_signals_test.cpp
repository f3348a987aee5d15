// Signals: the program is gone within a second, says so, and leaves nothing behind.
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <tuple>

#include "tests/cli/program.h"
#include "tests/cli/running_program.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::EndsWith;

const std::tuple<int, int, const char*> signals[] = {
    {SIGINT, 130, "SIGINT"}, {SIGTERM, 143, "SIGTERM"}, {SIGHUP, 129, "SIGHUP"}};

class Signals : public ProgramTest {
 protected:
  std::string message(const char* name, const char* end = "nothing written") const {
    return std::string("boule: interrupted (") + name + "), " + end + "\r\n";
  }
};

TEST_F(Signals, WhileRenderingEndTheBarsLineFirst) {
  for (const auto& [signal, code, name] : signals) {
    RunningProgram program(
        {"render", small_scene(), "-o", path("out.png"), "--size", "2000x2000", "--spp", "200"});
    ASSERT_TRUE(program.wait_for("Mray/s"));
    const Watch watch;
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_LT(watch.seconds(), 1);
    EXPECT_EQ(run.exit_code, code);
    EXPECT_THAT(run.out, EndsWith("\r\n" + message(name)));
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 2) << run.out;
    EXPECT_THAT(files(), ElementsAre("scene.toml"));
  }
}

TEST_F(Signals, WhileAFifoHasNoReaderEndIt) {
  for (const char* name : {"out.png", "hits.npy"}) {
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
  }
  write("rays.npy", npy_file(npy_dict("'<f4'", "(0, 8)"), ""));
  const std::vector<std::string> render = {"render", small_scene(), "-o", path("out.png"), "-q"};
  std::vector<std::string> partial = render;
  partial.emplace_back("--partial");
  const std::vector<std::string> trace = {"trace", small_scene(),    "--rays", path("rays.npy"),
                                          "-o",    path("hits.npy"), "-q"};
  for (const auto& arguments : {render, partial, trace}) {
    RunningProgram program(arguments);
    ASSERT_TRUE(program.wait_for_sleep());
    const Watch watch;
    program.send(SIGTERM);
    const ProgramRun run = program.finish();
    EXPECT_LT(watch.seconds(), 1);
    EXPECT_EQ(run.exit_code, 143);
    EXPECT_EQ(run.out, message("SIGTERM"));
  }
}

/// A reader that comes late, and a link to what has no name of its own.
TEST_F(Signals, PipesGetThePictureWhenTheyAreRead) {
  ASSERT_EQ(boule_run({"render", small_scene(), "-o", path("whole.png"), "-q"}).exit_code, 0);
  std::filesystem::create_symlink("/dev/stdout", path("stdout.png"));
  ASSERT_EQ(mkfifo(path("fifo.png").c_str(), 0600), 0);
  const std::string program = "cd " + path("") + "; \"" BOULE_PROGRAM "\" render scene.toml -q -o ";
  for (const std::string& line :
       {program + "stdout.png | cat > copy.png",
        program + "fifo.png & sleep 0.5; cat fifo.png > copy.png; wait"}) {
    write("copy.png", "");
    EXPECT_EQ(run_program("/bin/sh", {{"-c", line}, {}}).err, "");
    EXPECT_TRUE(read("copy.png") == read("whole.png")) << line;
  }
}

TEST_F(Signals, WhileLoadingEndItAtOnce) {
  std::string text = "schema = 1\n";
  for (int i = 0; i < 400'000; ++i) text += "[[sphere]]\ncenter = [1.0, 2.0, 3.0]\nradius = 1.5\n";
  const std::string scene = write("long.toml", text);  // takes seconds to read
  for (const auto& [signal, code, name] : signals) {
    RunningProgram program({"render", scene, "-o", path("out.png"), "-v"});
    ASSERT_TRUE(program.wait_for_work(0.3));
    const Watch watch;
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_LT(watch.seconds(), 1);
    EXPECT_EQ(run.exit_code, code);
    EXPECT_EQ(run.out, message(name));  // no note yet: it was still reading
    EXPECT_THAT(files(), ElementsAre("long.toml"));
  }
}

TEST_F(Signals, WhileBuildingEndItAtOnce) {
  constexpr std::uintmax_t spheres = 6'000'000;
  const std::string cloud = write("cloud.npy", npy_file(npy_dict("'<f4'", "(6000000, 3)"), ""));
  std::filesystem::resize_file(cloud, read("cloud.npy").size() + spheres * 12);
  const std::string scene =
      write("cloud.toml", "schema = 1\n[[spheres]]\nfile = \"cloud.npy\"\nradius = 1\n");
  for (const auto& [signal, code, name] : signals) {
    RunningProgram program({"render", scene, "-o", path("out.png"), "-v"});
    const std::string told = "boule: preparing " + scene + " ...\r\n";
    ASSERT_TRUE(program.wait_for(told));
    const Watch watch;
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_LT(watch.seconds(), 1);
    EXPECT_EQ(run.exit_code, code);
    EXPECT_THAT(run.out, EndsWith(told + message(name)));  // not prepared yet
    EXPECT_THAT(files(), ElementsAre("cloud.npy", "cloud.toml"));
  }
}

TEST_F(Signals, WhileWritingRemoveTheTemporaryFile) {
  // Quick to render, seconds to pack.
  const std::string scene = write("sky.toml",
                                  "schema = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [1, 2, 3]\n"
                                  "[background]\ntype = \"gradient\"\n");
  for (const auto& [signal, code, name] : signals) {
    RunningProgram program({"render", scene, "-o", path("out.exr"), "--size", "3000x3000", "-t",
                            "1", "--progress", "none"});
    ASSERT_TRUE(program.wait_for_output(path(""), 1 << 20));
    const Watch watch;
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_LT(watch.seconds(), 1);
    EXPECT_EQ(run.exit_code, code);
    EXPECT_EQ(run.out, message(name));
    EXPECT_THAT(files(), ElementsAre("sky.toml"));
  }
}

/// WebP is packed in one call, which asks nobody: the handler itself removes the file.
TEST_F(Signals, WhilePackingInOneCallRemoveTheTemporaryFile) {
  const std::string scene = write("sky.toml",
                                  "schema = 1\n[camera]\neye = [0, 0, 0]\nlook_at = [1, 2, 3]\n"
                                  "[background]\ntype = \"gradient\"\n");
  RunningProgram program(
      {"render", scene, "-o", path("out.webp"), "--size", "8000x6000", "--progress", "none"});
  ASSERT_TRUE(program.wait_for_output(path(""), 0));
  ASSERT_TRUE(program.wait_for_work(1.2));  // the tone curve is over: it is packing
  const Watch watch;
  program.send(SIGTERM);
  const ProgramRun run = program.finish();
  EXPECT_LT(watch.seconds(), 1);
  EXPECT_EQ(run.exit_code, 143);
  EXPECT_EQ(run.out, message("SIGTERM"));
  EXPECT_THAT(files(), ElementsAre("sky.toml"));
}

TEST_F(Signals, WhileAPipesReaderIsSlowStopTheWait) {
  const std::string pipe = path("out.ppm");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& [signal, code, name] : signals) {
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);  // and never reads
    RunningProgram program(
        {"render", small_scene(), "-o", pipe, "--size", "640x480", "--progress", "none"});
    pollfd filled{reader, POLLIN, 0};
    ASSERT_EQ(poll(&filled, 1, 20'000), 1);
    ASSERT_TRUE(program.wait_for_sleep());  // the pipe is full
    const Watch watch;
    program.send(signal);
    const ProgramRun run = program.finish();
    EXPECT_LT(watch.seconds(), 1);
    EXPECT_EQ(run.exit_code, code);
    EXPECT_THAT(run.out, EndsWith(message(name, "the output is incomplete")));
    close(reader);
  }
}

}  // namespace
}  // namespace boule::test
