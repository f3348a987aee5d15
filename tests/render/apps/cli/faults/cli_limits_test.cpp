// What the system does not give: memory, stack, files, room on a disk, permission. The program says
// so, in the system's words, and leaves everything as it was; or does with less.
#include <unistd.h>

#include <csignal>
#include <utility>

#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"

namespace boule::test {
namespace {

class Limits : public ProgramTest {
 protected:
  static constexpr const char* old = "the old picture";

  /// Runs a line of the shell in the test's folder; "$@" is the program and `arguments`.
  ProgramRun shell(const std::string& line, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"-c", "cd '" + path("") + "' && " + line, "sh", BOULE_PROGRAM});
    return run_program("/bin/sh", {arguments, {}});
  }
  std::vector<std::string> render(const std::string& output,
                                  const std::string& threads = "3") const {
    return {"render", "scene.toml", "-o", output, "-t", threads};
  }

  /// Renders over the old picture within a limit of the shell's `ulimit`: "-v 1000".
  ProgramRun render_within(const std::string& limit, const std::string& threads = "3") const {
    write(picture_, old);
    return shell("ulimit " + limit + "; exec \"$@\"", render(picture_, threads));
  }

  /// The picture is whole, or the old one is there and an error says why; nothing else is there.
  void expect_all_or_nothing(const ProgramRun& run, const std::string& whole) const {
    // 3: there is no memory for the scene, whether that was found before or as it was asked for.
    EXPECT_THAT(run.exit_code, testing::AnyOf(0, 1, 3)) << run.err;
    EXPECT_EQ(read(picture_), run.exit_code == 0 ? whole : old);
    if (run.exit_code == 1) EXPECT_THAT(run.err, testing::HasSubstr("boule: error: "));
    if (run.exit_code == 3) {
      EXPECT_THAT(run.err,
                  testing::AnyOf(testing::HasSubstr("scene.toml: error: needs more memory"),
                                 testing::HasSubstr(" of memory, there are ")));
    }
    EXPECT_EQ(files(), (std::vector<std::string>{picture_, "scene.toml"}));
  }
  std::string whole_picture() const {
    small_scene();
    EXPECT_EQ(shell("exec \"$@\"", render(picture_)).exit_code, 0);
    return read(picture_);
  }

  std::string picture_ = "picture.png";  ///< EXR needs OpenImageIO's libraries, PNG does not
};

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadows are addresses
/// From less than the program starts with to more than the libraries of pictures need, in steps so
/// small that some runs are refused whichever of their threads asks first.
TEST_F(Limits, OnAddresses) {
  for (const auto& [name, least_refused] : {std::pair{"picture.exr", 8}, {"picture.png", 3}}) {
    picture_ = name;
    const std::string whole = whole_picture();
    int done = 0, refused = 0;
    for (int kibibytes = 12000; kibibytes < 1600000; kibibytes += kibibytes / 20) {
      const std::string limit = "-v " + std::to_string(kibibytes);
      const ProgramRun run = render_within(limit, "8");
      SCOPED_TRACE(limit + ": " + run.err);
      if (run.exit_code == 127) continue;  // the system could not start it
      expect_all_or_nothing(run, whole);
      ++(run.exit_code == 0 ? done : refused);
    }
    EXPECT_GE(done, 2) << name;
    EXPECT_GE(refused, least_refused) << name;
    std::filesystem::remove(path(picture_));
  }
}

/// OpenImageIO's pool crashes as it is destroyed if a thread of it could not be started. With these
/// limits that came about in one run out of ten, where two threads run at a time.
TEST_F(Limits, OnTheAddressesOfThreads) {
  picture_ = "picture.exr";
  const std::string whole = whole_picture();
  for (int kibibytes = 740000; kibibytes < 840000; kibibytes += 6000) {
    const std::string limit = "-v " + std::to_string(kibibytes);
    const ProgramRun run = render_within(limit, "8");
    SCOPED_TRACE(limit + ": " + run.err);
    if (run.exit_code != 127) expect_all_or_nothing(run, whole);
  }
}

/// Some libraries of pictures crash where malloc gives them nothing while they are loaded.
TEST_F(Limits, OnData) {
  for (const auto& [name, least_refused] : {std::pair{"picture.exr", 5}, {"picture.png", 1}}) {
    picture_ = name;
    const std::string whole = whole_picture();
    int done = 0, refused = 0;
    for (const int kibibytes : {4000, 10000, 20000, 40000, 80000, 88000, 92000, 96000, 100000,
                                110000, 130000, 150000, 400000}) {
      const std::string limit = "-d " + std::to_string(kibibytes);
      const ProgramRun run = render_within(limit, "2");
      SCOPED_TRACE(limit + ": " + run.err);
      expect_all_or_nothing(run, whole);
      if (run.exit_code != 0) {
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
      }
      ++(run.exit_code == 0 ? done : refused);
    }
    EXPECT_GE(done, 1) << name;
    EXPECT_GE(refused, least_refused) << name;
    std::filesystem::remove(path(picture_));
  }
}

TEST_F(Limits, OnTheStack) {
  const std::string whole = whole_picture();
  for (const int kibibytes : {160, 1000, 4000, 4096, 8192}) {
    const ProgramRun run = render_within("-s " + std::to_string(kibibytes));
    EXPECT_EQ(run.exit_code, kibibytes < 4096 ? 1 : 0) << kibibytes << run.err;
    expect_all_or_nothing(run, whole);
  }
}

/// (The sanitizer of undefined behaviour looks at objects through a pipe.)
TEST_F(Limits, OnOpenFiles) {
  const std::string whole = whole_picture();
  for (int files = 4; files < 12; ++files) {
    const ProgramRun run = render_within("-n " + std::to_string(files));
    if (run.exit_code == 127) continue;  // no library of its own was found
    expect_all_or_nothing(run, whole);
    if (run.exit_code != 0) {
      EXPECT_THAT(run.err, testing::HasSubstr("Too many open files"));
    }
  }
}
#endif

TEST_F(Limits, OnTheSizeOfFiles) {
  whole_picture();
  write("rays.npy", "");
  for (const std::string name : {"picture.exr", "picture.png"}) {
    write(name, old);
    const auto all = files();
    // What the program says goes to a file, too.
    const ProgramRun run = shell("(ulimit -f 0; \"$@\" 2>&1) | cat; ls -A", render(name));
    EXPECT_THAT(run.out, testing::HasSubstr("cannot write '" + name + "': File too large"));
    EXPECT_EQ(read(name), old);
    EXPECT_EQ(files(), all);
  }
}

/// In a namespace of mounts of its own, where that is allowed.
TEST_F(Limits, OnTheDisk) {
  small_scene();
  if (shell("unshare -rm true", {}).exit_code != 0) GTEST_SKIP() << "namespaces are not allowed";
  std::filesystem::create_directory(path("small"));
  for (const std::string name : {"picture.exr", "picture.png"}) {
    const std::string line =
        "unshare -rm sh -c 'mount -t tmpfs -o size=4k,nr_inodes=9 none small && printf old "
        ">small/" +
        name + " && \"$@\"; echo code $?; cat small/" + name + "; ls -A small' sh \"$@\"";
    const ProgramRun run =
        shell(line, {"render", "scene.toml", "-o", "small/" + name, "--size", "99x99"});
    EXPECT_EQ(run.out, "code 1\nold" + name + "\n");
    EXPECT_THAT(run.err,
                testing::HasSubstr("cannot write 'small/" + name + "': No space left on device"));
  }
}

TEST_F(Limits, AReadOnlyFileSystem) {
  small_scene();
  if (shell("unshare -rm true", {}).exit_code != 0) GTEST_SKIP() << "namespaces are not allowed";
  std::filesystem::create_directory(path("still"));
  const std::string line =
      "unshare -rm sh -c 'mount -t tmpfs none still && printf old >still/a.png && "
      "mount -o remount,ro none still && \"$@\"; echo code $?; cat still/a.png; ls -A still' sh "
      "\"$@\"";
  const ProgramRun run = shell(line, render("still/a.png"));
  EXPECT_EQ(run.out, "code 1\nolda.png\n");
  EXPECT_THAT(run.err, testing::HasSubstr("cannot write 'still/a.png': Read-only file system"));
}

/// Root may write everywhere: it becomes somebody else.
TEST_F(Limits, AFolderOfOthers) {
  small_scene();
  const bool root = ::geteuid() == 0;
  const std::string become =
      root ? "setpriv --reuid 65534 --regid 65534 --clear-groups --inh-caps=-all " : "";
  std::filesystem::create_directory(path("theirs"));
  write("theirs/a.png", old);
  std::filesystem::permissions(path(""), std::filesystem::perms{0755});
  std::filesystem::permissions(path("theirs"), std::filesystem::perms{0555});
  if (shell("exec " + become + "\"$@\"", {"--version"}).exit_code != 0) {
    GTEST_SKIP() << "cannot become somebody else who may start the program";
  }
  for (const std::string name : {"a.png", "b.png"}) {
    const ProgramRun run = shell("exec " + become + "\"$@\"", render("theirs/" + name));
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.err,
                testing::HasSubstr("cannot write 'theirs/" + name + "': Permission denied"));
  }
  EXPECT_EQ(read("theirs/a.png"), old);
  EXPECT_FALSE(std::filesystem::exists(path("theirs/b.png")));
  std::filesystem::permissions(path("theirs"), std::filesystem::perms{0755});
}

TEST_F(Limits, AFolderThatVanishes) {
  const std::string scene = small_scene();
  const auto before = files();
  std::filesystem::create_directory(path("gone"));
  RunningProgram program({"render", scene, "-o", path("gone/a.png"), "--size", "400x400", "--spp",
                          "2000000000", "--partial"});
  ASSERT_TRUE(program.wait_for("Mray/s"));
  std::filesystem::remove(path("gone"));
  program.send(SIGTERM);  // it would write the picture now
  const ProgramRun run = program.finish();
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.out, testing::HasSubstr("cannot write '" + path("gone/a.png") +
                                          "': No such file or directory"));
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace boule::test
