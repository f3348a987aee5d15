// What can be known of an output is told before anything is read: here there is nothing to read.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>

#include "tests/render/apps/cli/trace/trace_program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// No scene and no rays are there: who complains of the output has looked at it first.
class OutputCheck : public Trace {
 protected:
  void expect_refused(const Arguments& arguments, const std::string& name,
                      const std::string& reason) const {
    const ProgramRun run = refused_run(arguments, 1);
    EXPECT_EQ(run.err, "boule: error: cannot write '" + name + "': " + reason + "\n");
  }
  Arguments render(const std::string& output) const {
    return {"render", path("none.toml"), "-o", output};
  }
  Arguments trace(const std::string& output) const {
    return {"trace", path("none.toml"), "--rays", path("none.npy"), "-o", output};
  }
  static Arguments with_stats(Arguments arguments, const std::string& file) {
    arguments.push_back("--stats=json:" + file);
    return arguments;
  }
  /// Files of this name, of each kind.
  void expect_all_refused(const std::string& stem, const std::string& reason) const {
    const std::string picture = stem + ".png", hits = stem + ".npy", stats = stem + ".json";
    expect_refused(render(picture), picture, reason);
    expect_refused(trace(hits), hits, reason);
    expect_refused(with_stats(render(path("x.png")), stats), stats, reason);
    expect_refused(with_stats(trace(path("x.npy")), stats), stats, reason);
  }
};

TEST_F(OutputCheck, FoldersThatAreNone) {
  expect_all_refused(path("no/such"), "No such file or directory");
  write("file", "");
  expect_all_refused(path("file/x"), "Not a directory");
  std::filesystem::create_symlink("no/where.png", path("link.png"));
  expect_refused(render(path("link.png")), path("link.png"), "No such file or directory");
}

TEST_F(OutputCheck, OutputsThatAreFolders) {
  for (const char* name : {"x.png", "x.npy", "x.json"}) {
    std::filesystem::create_directory(path(name));
  }
  const std::string reason = "Is a directory";
  expect_refused(render(path("x.png")), path("x.png"), reason);
  expect_refused(trace(path("x.npy")), path("x.npy"), reason);
  expect_refused(with_stats(render(path("y.png")), path("x.json")), path("x.json"), reason);
}

TEST_F(OutputCheck, FoldersThatNobodyWritesTo) {
  if (!std::filesystem::is_directory("/sys/kernel")) GTEST_SKIP() << "no /sys here";
  const ProgramRun run = refused_run(render("/sys/kernel/x.png"), 1);
  EXPECT_THAT(run.err, StartsWith("boule: error: cannot write '/sys/kernel/x.png': "));
}

TEST_F(OutputCheck, WhatIsWriteProtected) {
  if (geteuid() == 0) GTEST_SKIP() << "nothing is write-protected for root";
  for (const char* name : {"x.png", "x.npy", "x.json"}) chmod(write(name, "old").c_str(), 0400);
  expect_all_refused(path("x"), "Permission denied");
  std::filesystem::create_directory(path("folder"));
  ASSERT_EQ(boule_run({"render", small_scene(), "-o", path("folder/done.exr"), "-q"}).exit_code, 0);
  chmod(path("folder").c_str(), 0500);
  expect_all_refused(path("folder/x"), "Permission denied");
  // A picture that stays as it is need not be writable.
  const ProgramRun run =
      boule_run({"render", small_scene(), "-o", path("folder/done.exr"), "--skip-existing"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("is there already, skipped"));
  chmod(path("folder").c_str(), 0700);
}

TEST_F(OutputCheck, SocketsAreNoOutputs) {
  const std::string name = path("s.png");
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(name.size(), sizeof address.sun_path);
  std::memcpy(address.sun_path, name.c_str(), name.size());
  ASSERT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  expect_refused(render(name), name, "No such device or address");
  close(socket);
}

TEST_F(OutputCheck, FirstFrameOfASeriesIsNamed) {
  const ProgramRun run =
      refused_run({"render", path("none.toml"), "-o", path("no/x.##.png"), "--frames", "7-9"}, 1);
  EXPECT_EQ(run.err, "boule: error: frame 7: cannot write '" + path("no/x.07.png") +
                         "': No such file or directory\n");
}

TEST_F(OutputCheck, StatisticsNeedAStandardOutput) {
  const std::string line = "\"" BOULE_PROGRAM "\" render " + path("none.toml") + " -o " +
                           path("x.png") + " --stats json >&-";
  const ProgramRun run = run_program("/bin/sh", {{"-c", line}, {}});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(run.err, "boule: error: cannot write 'standard output': Bad file descriptor\n");
}

/// Looking is not touching: of a run that fails later nothing is seen.
TEST_F(OutputCheck, OldFileStaysUntilTheNewOne) {
  write("x.png", "old");
  ASSERT_EQ(mkfifo(path("pipe.png").c_str(), 0600), 0);
  for (const char* name : {"x.png", "pipe.png", "new.png"}) {
    const ProgramRun run = refused_run(render(path(name)), 3);
    EXPECT_THAT(run.err, HasSubstr("none.toml: error: cannot read it"));
  }
  EXPECT_EQ(read("x.png"), "old");
  EXPECT_THAT(files(), ElementsAre("pipe.png", "x.png"));
}

}  // namespace
}  // namespace boule::test
