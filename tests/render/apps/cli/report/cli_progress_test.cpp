// What is told while rendering: on a terminal, on a pipe, for programs, or not at all.
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"

namespace boule::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class Progressing : public ProgramTest {
 protected:
  std::vector<std::string> command(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path("x.ppm")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
  }
  ProgramRun render(const std::vector<std::string>& options) const {
    ProgramRun run = boule_run(command(options));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, IsEmpty());
    return run;
  }
  static std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
  }
};

const std::vector<std::string> half_a_second = {"--size", "640x360", "--spp", "4"};

/// The share of a line like "boule:  42 % [##..] 0.5 s elapsed, 0.7 s left, 12.3 Mray/s", else -1.
/// Instead of the speed it may say what it waits for. (By hand: std::regex trips GCC 12's
/// -Wmaybe-uninitialized under sanitizers.)
int share_of_drawn_line(const std::string& line) {
  int share = -1;
  int read = 0;
  char bar[64] = {};
  double elapsed = 0;
  const int fields = std::sscanf(line.c_str(), "boule: %d %% [%63[#.]] %lf s elapsed, %n", &share,
                                 bar, &elapsed, &read);
  const std::string rest = fields == 3 ? line.substr(static_cast<std::size_t>(read)) : "";
  const std::string what = rest.substr(0, rest.find_last_not_of(' ') + 1);  // blanked from before
  const bool speed = what.find(" left, ") != std::string::npos && what.ends_with(" Mray/s");
  const bool whole = speed || what.find("waiting for ") != std::string::npos;
  const bool ordered = std::string_view(bar).find(".#") == std::string_view::npos;
  return whole && ordered ? share : -1;
}

TEST_F(Progressing, TerminalLineIsRewritten) {
  const Watch watch;
  RunningProgram program(command(half_a_second));
  const ProgramRun run = program.finish();
  const double seconds = watch.seconds();
  EXPECT_EQ(run.exit_code, 0);
  const auto lines = split(run.out, '\n');
  ASSERT_EQ(lines.size(), 2u) << run.out;  // the bar's line, the summary
  EXPECT_THAT(lines[1], HasSubstr("640 x 360 pixels"));
  auto drawn = split(lines[0], '\r');
  ASSERT_GE(drawn.size(), 2u);
  EXPECT_THAT(drawn[0], IsEmpty());
  drawn.erase(drawn.begin());
  EXPECT_LE(static_cast<double>(drawn.size()), 10 * seconds + 2);
  int last = 0;
  for (const std::string& line : drawn) {
    if (line.find(" ... ") != std::string::npos) continue;  // of what took long before
    const int share = share_of_drawn_line(line);
    ASSERT_GE(share, last) << line;
    last = share;
  }
  EXPECT_EQ(last, 100);
}

TEST_F(Progressing, ANarrowTerminalIsNotOverrun) {
  RunningProgram program(command({}), 30);
  auto lines = split(program.finish().out, '\n');
  std::erase_if(lines, [](const std::string& line) {  // of what took long before
    return line.find(" ...") != std::string::npos;
  });
  ASSERT_EQ(lines.size(), 2u);
  for (const std::string& drawn : split(lines[0], '\r')) EXPECT_LE(drawn.size(), 29u) << drawn;
}

/// What is done within two seconds tells nobody how far it has come.
TEST_F(Progressing, PipeHasNoneInShortRuns) {
  const Watch watch;
  const auto lines = split(run_program(BOULE_PROGRAM, {command({}), {}}).err, '\n');
  if (watch.seconds() >= 2) GTEST_SKIP() << "it was no short run";
  ASSERT_EQ(lines.size(), 1u) << lines[0];
  EXPECT_THAT(lines[0], HasSubstr("x.ppm: 32 x 18 pixels"));
}

/// Rendering goes on until the line is there.
TEST_F(Progressing, APipeHasPlainLinesByDefault) {
  auto arguments = command({"--size", "4000x4000", "--spp", "10000", "--progress", "plain"});
  RunningProgram program(arguments);
  ASSERT_TRUE(program.wait_for(" elapsed, "));
  program.send(SIGTERM);
  auto lines = split(program.finish().out, '\n');
  std::erase_if(lines, [](const std::string& line) {  // of what took long before
    return line.find(" ...") != std::string::npos;
  });
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0], StartsWith("boule:   "));
  EXPECT_THAT(lines[0], HasSubstr(" %, "));
  EXPECT_THAT(lines[1], HasSubstr("interrupted"));
}

TEST_F(Progressing, TheStyleCanBeChosen) {
  EXPECT_THAT(render({"--progress", "bar"}).err, StartsWith("\rboule: "));
  EXPECT_THAT(render({"--progress", "auto"}).err, Not(HasSubstr("\r")));
  EXPECT_THAT(render({"--progress", "none"}).err, Not(HasSubstr("%")));
  RunningProgram on_terminal(command({"--progress", "plain"}));
  EXPECT_THAT(on_terminal.finish().out, Not(HasSubstr("\rboule")));
}

TEST_F(Progressing, JsonLinesAreForPrograms) {
  auto options = half_a_second;
  options.insert(options.end(), {"--progress", "json"});
  auto lines = split(render(options).err, '\n');
  ASSERT_GE(lines.size(), 3u);
  lines.pop_back();  // the summary
  double last = 0;
  for (const std::string& line : lines) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json.size(), 4u);
    EXPECT_GE(json.at("share").get<double>(), last);
    last = json.at("share").get<double>();
    EXPECT_GE(json.at("elapsed_s").get<double>(), 0);
    EXPECT_TRUE(json.at("remaining_s").is_number());
    EXPECT_GT(json.at("mrays_per_s").get<double>(), 0);
  }
  EXPECT_EQ(last, 1);
}

/// A note that says nothing new, and frames that take no time.
TEST_F(Progressing, SeriesTakesAFewLines) {
  for (const char* name : {"a.01.toml", "a.02.toml", "a.03.toml"}) {
    write(name, "schema = 1\n[render]\nmethod = \"whitted\"\n[[sphere]]\n");
  }
  const ProgramRun run = boule_run(
      {"render", path("a.##.toml"), "-o", path("o##.ppm"), "--frames", "1-3", "--size", "8x8"});
  EXPECT_EQ(run.exit_code, 0);
  const auto lines = split(run.err, '\n');
  ASSERT_EQ(lines.size(), 3u) << run.err;
  EXPECT_THAT(lines[0], HasSubstr("note: the camera is fitted"));
  EXPECT_THAT(lines[1], HasSubstr("note: no light in the scene"));
  EXPECT_THAT(lines[2], StartsWith("boule: " + path("o##.ppm") + ": 3 frames, "));
  const ProgramRun verbose = boule_run({"render", path("a.##.toml"), "-o", path("o##.ppm"),
                                        "--frames", "1-3", "--size", "8x8", "-v"});
  for (const char* name : {"o01.ppm", "o02.ppm", "o03.ppm"}) {
    EXPECT_THAT(verbose.err, HasSubstr("boule: " + path(name) + ": 8 x 8 pixels"));
  }
}

TEST_F(Progressing, TerminalHasOneLinePerSeries) {
  RunningProgram program({"render", small_scene(), "-o", path("o#.ppm"), "--frames", "1-3"});
  const ProgramRun run = program.finish();
  EXPECT_EQ(run.exit_code, 0);
  const auto lines = split(run.out, '\n');
  ASSERT_EQ(lines.size(), 2u) << run.out;  // the bar's line, the summary
  EXPECT_THAT(lines[0], HasSubstr("frame 1 of 3, "));
  EXPECT_THAT(lines[0], HasSubstr("boule: 100 % ["));
  EXPECT_THAT(lines[1], HasSubstr("o#.ppm: 3 frames, "));
}

TEST_F(Progressing, QuietSilencesEveryStyle) {
  for (const char* style : {"auto", "bar", "plain", "json", "none"}) {
    EXPECT_THAT(render({"-q", "--progress", style}).err, IsEmpty()) << style;
  }
  RunningProgram on_terminal(command({"-q"}));
  EXPECT_THAT(on_terminal.finish().out, IsEmpty());
}

TEST_F(Progressing, VerboseAddsNotes) {
  const ProgramRun run = render({"-v"});
  EXPECT_THAT(run.err, HasSubstr("scene.toml: 1 sphere, 1 plane, 1 light, 2 materials, read in"));
  EXPECT_THAT(run.err, HasSubstr("note: prepared in "));
  EXPECT_THAT(run.err, HasSubstr("note: written in "));
  EXPECT_THAT(render({}).err, Not(HasSubstr("note")));
}

}  // namespace
}  // namespace boule::test
