// Descriptors that the program is started without: nothing else may take their places.
#include "tests/render/apps/cli/trace/trace_program.h"

namespace boule::test {
namespace {

using testing::IsEmpty;
using testing::Not;

class ClosedStreams : public Trace {
 protected:
  /// Runs the program in the test's folder, with redirections as a shell has them.
  ProgramRun run(const std::string& arguments, const std::string& redirections) const {
    const std::string line =
        "cd " + path("") + " && \"" BOULE_PROGRAM "\" " + arguments + " " + redirections;
    return run_program("/bin/sh", {{"-c", line}, {}});
  }

  /// Which streams are closed.
  struct Choice {
    bool in, out, err;

    [[nodiscard]] std::string text() const {
      return std::string(in ? "<&- " : "") + (out ? ">&- " : "") + (err ? "2>&-" : "");
    }
  };
  static std::vector<Choice> choices() {
    std::vector<Choice> all;
    for (unsigned bits = 1; bits < 8; ++bits) {
      all.push_back({(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0});
    }
    return all;
  }

  /// Runs a command that writes `output`, first as usual: the file is the same without streams.
  void expect_same_file(const std::string& arguments, const std::string& output) const {
    ASSERT_EQ(run(arguments, "").exit_code, 0);
    const std::string expected = read(output);
    for (const Choice& closed : choices()) {
      SCOPED_TRACE(arguments + " " + closed.text());
      std::filesystem::remove(path(output));
      const ProgramRun found = run(arguments, closed.text());
      EXPECT_EQ(found.exit_code, 0) << found.err;
      EXPECT_TRUE(read(output) == expected);
      EXPECT_THAT(found.out, IsEmpty());
    }
  }
};

TEST_F(ClosedStreams, HitsAndPicturesNeedNoStandardStreams) {
  small_scene();
  write("r.npy", ray_file(ray_cloud(20)));
  expect_same_file("trace scene.toml --rays r.npy -o h.npy --progress json -v", "h.npy");
  expect_same_file("render scene.toml -o p.ppm --progress json -v", "p.ppm");
  expect_same_file("render scene.toml -o p.exr --progress plain --stats text", "p.exr");
}

TEST_F(ClosedStreams, DataWithoutATargetAreAnError) {
  small_scene();
  for (const char* command : {"info scene.toml", "isa --json", "--version", "render --help"}) {
    const std::string expected = run(command, "").out;
    ASSERT_THAT(expected, Not(IsEmpty()));
    for (const Choice& closed : choices()) {
      SCOPED_TRACE(command + (" " + closed.text()));
      const ProgramRun found = run(command, closed.text());
      EXPECT_EQ(found.exit_code, closed.out ? 1 : 0);
      EXPECT_EQ(found.out, closed.out ? "" : expected);
      const bool told = closed.out && !closed.err;
      EXPECT_EQ(found.err, told ? "boule: error: cannot write 'standard output': "
                                  "Bad file descriptor\n"
                                : "");
    }
  }
}

/// As `| head -1`, which may leave before anything is written: silence, and the exit code of
/// SIGPIPE.
TEST_F(ClosedStreams, LeavingReaderEndsACommandSilently) {
  small_scene();
  const auto piped = [&](const std::string& arguments, const std::string& before,
                         const std::string& reader) {
    const std::string line = "cd " + path("") + " && { " + before + "\"" BOULE_PROGRAM "\" " +
                             arguments + "; echo $? >code; } 2>told | " + reader;
    run_program("/bin/sh", {{"-c", line}, {}});
    EXPECT_EQ(read("told"), "") << arguments;
    return read("code");
  };
  const auto unread = [&](const std::string& arguments) {
    std::filesystem::remove(path("closed"));
    return piped(arguments, "until [ -e closed ]; do sleep 0.01; done; ",
                 "{ exec <&-; : >closed; }");
  };
  for (const char* command : {"info scene.toml --json", "isa --json", "--version", "render --help",
                              "help", "render scene.toml -q -o - --format ppm"}) {
    SCOPED_TRACE(command);
    EXPECT_EQ(unread(command), "141\n");
    for (int i = 0; i < 7; ++i)
      EXPECT_THAT(piped(command, "", "head -c 1"), testing::AnyOf("0\n", "141\n"));
  }
  // The files of a run are what it is for.
  EXPECT_EQ(unread("render scene.toml -q -o f.##.ppm --frames 1-3 --stats json"), "0\n");
  for (const char* frame : {"f.01.ppm", "f.02.ppm", "f.03.ppm"}) EXPECT_NE(read(frame), "");
}

}  // namespace
}  // namespace boule::test
