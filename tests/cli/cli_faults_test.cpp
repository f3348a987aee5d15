// Calls of the system that fail, one after the other: the program says so, in the system's words,
// or does without; the old picture stays, or the new one is whole; nothing is left behind.
#include <cerrno>
#include <cstring>
#include <optional>
#include <ostream>

#include "tests/cli/program.h"

namespace boule::test {
namespace {

struct Fault {
  std::string name;
  std::string call;
  int code;
};
std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.name; }

class Faults : public ProgramTest, public testing::WithParamInterface<Fault> {
 protected:
  /// What came of a run whose n-th call failed; none where there were fewer calls.
  std::optional<ProgramRun> run_with_fault(const std::vector<std::string>& arguments,
                                           const Fault& fault, int n) const {
    const std::string mark = path("mark");
    const ProgramRun run = boule_run(
        arguments,
        {"LD_PRELOAD=" BOULE_FAULT_INJECTOR, "BOULE_FAULT_HIT=" + mark,
         "BOULE_FAULT=" + fault.call + " " + std::to_string(n) + " " + std::to_string(fault.code)});
    if (!std::filesystem::remove(mark)) return std::nullopt;
    return run;
  }
};

class FaultsWhileRendering : public Faults {};

TEST_P(FaultsWhileRendering, KeepTheOldPictureOrFinishTheNewOne) {
  const Fault& fault = GetParam();
  const std::string scene = small_scene();
  for (const std::string extension : {"exr", "png"}) {
    const std::string name = "picture." + extension, old = "the old picture";
    const std::vector<std::string> arguments{"render", scene, "-o", path(name), "-t", "2"};
    ASSERT_EQ(boule_run(arguments).exit_code, 0);
    const std::string whole = read(name);
    const auto all_files = files();
    int failed = 0, n = 1;
    for (;; ++n) {
      ASSERT_LT(n, 1000);
      write(name, old);
      const auto run = run_with_fault(arguments, fault, n);
      if (!run) break;
      const std::string what = fault.name + " " + std::to_string(n) + ": " + run->err;
      EXPECT_TRUE(run->exit_code == 0 || run->exit_code == 1 || run->exit_code == 3) << what;
      EXPECT_EQ(read(name) == whole, run->exit_code == 0) << what;
      EXPECT_EQ(read(name) == old, run->exit_code != 0) << what;
      EXPECT_EQ(files(), all_files) << what;
      if (run->exit_code == 0) continue;
      ++failed;
      EXPECT_THAT(run->err, testing::HasSubstr("error: ")) << what;
      EXPECT_THAT(run->err, testing::HasSubstr(std::strerror(fault.code))) << what;
    }
    EXPECT_GT(n, 1) << "the program makes no such call";
    RecordProperty(extension + "_calls", n - 1);
    RecordProperty(extension + "_failures", failed);
  }
}

const Fault files_and_threads[] = {{"OpenWithoutPermission", "open", EACCES},
                                   {"OpenTooManyFiles", "open", EMFILE},
                                   {"OpenNoUnnamedFiles", "open", EOPNOTSUPP},
                                   {"ReadBadDisk", "read", EIO},
                                   {"WriteFullDisk", "write", ENOSPC},
                                   {"WriteBadDisk", "write", EIO},
                                   {"WriteQuota", "write", EDQUOT},
                                   {"CloseBadDisk", "close", EIO},
                                   {"CloseQuota", "close", EDQUOT},
                                   {"SyncBadDisk", "fsync", EIO},
                                   {"SyncFullDisk", "fsync", ENOSPC},
                                   {"RenameReadOnly", "rename", EROFS},
                                   {"RenameBadDisk", "rename", EIO},
                                   {"NameInNoFolder", "linkat", ENOENT},
                                   {"NameOnAFullDisk", "linkat", ENOSPC},
                                   {"NoThread", "thread", EAGAIN}};
INSTANTIATE_TEST_SUITE_P(System, FaultsWhileRendering, testing::ValuesIn(files_and_threads),
                         [](const auto& fault) { return fault.param.name; });

/// Pictures are read where a scene has a map or an environment, and where finished ones are
/// skipped; OpenImageIO and the libraries below it would end the program without their threads.
TEST_F(Faults, PicturesAreReadOnlyWhereTheThreadsForThatCanBeHad) {
  const Fault no_thread{"NoThread", "thread", EAGAIN};
  for (const std::string extension : {"exr", "png", "jpg", "tif"}) {
    const std::string map = "map." + extension;
    ASSERT_EQ(boule_run({"render", small_scene(), "-o", path(map)}).exit_code, 0);
    const std::string keys =
        "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
        "[camera.distortion]\nfile = \"" +
        map + "\"\n";
    const std::string distorted = write("distorted.toml", keys);
    const std::string sky = write(
        "sky.toml", "schema = 1\n[background]\ntype = \"environment\"\nfile = \"" + map + "\"\n");
    const std::vector<std::vector<std::string>> commands = {
        {"info", distorted},
        {"info", sky},
        {"render", small_scene(), "-o", path(map), "--skip-existing", "-t", "2"},
        {"render", sky, "-o", path("x." + extension), "--size", "8x8", "-t", "2"}};
    for (const auto& command : commands) {
      const auto all_files = files();
      int n = 1;
      for (;; ++n) {
        ASSERT_LT(n, 100);
        const auto run = run_with_fault(command, no_thread, n);
        if (!run) break;
        const std::string what = command[1] + " " + map + ", thread " + std::to_string(n) + ": ";
        std::filesystem::remove(path("x." + extension));
        EXPECT_EQ(files(), all_files) << what;
        if (run->exit_code == 0) continue;
        EXPECT_TRUE(run->exit_code == 1 || run->exit_code == 3) << what << run->exit_code;
        EXPECT_THAT(run->err, testing::HasSubstr("error: ")) << what;
        EXPECT_THAT(run->err, testing::HasSubstr(std::strerror(EAGAIN))) << what;
      }
      EXPECT_GT(n, 4) << "the program starts no such threads";
    }
  }
}

/// From the n-th allocation on there is no memory.
TEST_F(Faults, WithoutMemoryTheOldPictureStays) {
  const std::string scene = small_scene(), old = "the old picture";
  const std::vector<std::string> arguments{"render", scene, "-o", path("picture.png"), "-t", "2"};
  ASSERT_EQ(boule_run(arguments).exit_code, 0);
  const std::string whole = read("picture.png");
  const auto all_files = files();
  int n = 1, runs = 0, crashes = 0;
  for (;; n += 1 + n / 10, ++runs) {
    write("picture.png", old);
    const auto run = run_with_fault(arguments, {"NoMemory", "malloc", ENOMEM}, n);
    if (!run) break;
    const std::string what = "allocation " + std::to_string(n) + ": " + run->err;
    const bool told = run->exit_code != 0 && run->err.find("error: ") != std::string::npos;
    EXPECT_TRUE(run->exit_code == 0 || run->exit_code >= 126 || told) << what;
    crashes += run->exit_code > 128 ? 1 : 0;
    EXPECT_EQ(read("picture.png") == old, run->exit_code != 0) << what;
    EXPECT_EQ(read("picture.png") == whole, run->exit_code == 0) << what;
    EXPECT_EQ(files(), all_files) << what;
  }
  EXPECT_GT(runs, 40);
  // Before main, and where libraries of OpenImageIO's begin: GnuTLS and GLib end the process then.
  EXPECT_LT(crashes, runs / 4);
}

}  // namespace
}  // namespace boule::test
