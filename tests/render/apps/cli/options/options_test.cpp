// What is typed, and what is answered: the command line without the program.
#include "render/apps/cli/options/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "render/apps/job/options/option_values.h"

namespace boule::cli {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Parses words as the shell would cut them at blanks.
Command parse(const std::string& line) {
  std::vector<std::string> words{"boule"};
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

UsageError refused(const std::string& line) {
  const Command command = parse(line);
  const auto* error = std::get_if<UsageError>(&command);
  EXPECT_NE(error, nullptr) << line;
  return error != nullptr ? *error : UsageError{};
}

std::string told(const std::string& line) {
  const Command command = parse(line);
  const auto* text = std::get_if<TextCommand>(&command);
  EXPECT_NE(text, nullptr) << line;
  return text != nullptr ? text->text : "";
}

struct Slip {
  std::string line, text, help;
};

std::ostream& operator<<(std::ostream& out, const Slip& slip) { return out << slip.line; }

class Slips : public testing::TestWithParam<Slip> {};

TEST_P(Slips, AreToldWithWhatWasMeant) {
  const UsageError error = refused(GetParam().line);
  EXPECT_EQ(error.text, GetParam().text);
  EXPECT_EQ(error.help, GetParam().help);
}

const std::string all = "boule --help", of_render = "boule render --help";

const Slip slips[] = {
    {"rander", "unknown command 'rander'; did you mean 'render'?", all},
    {"ifno a.toml --json", "unknown command 'ifno'; did you mean 'info'?", all},
    {"hlep render", "unknown command 'hlep'; did you mean 'help'?", all},
    {"help rendre", "unknown command 'rendre'; did you mean 'render'?", all},
    {"polish", "unknown command 'polish'", all},
    {"a/b.toml -o c.png", "unknown command 'a/b.toml'; did you mean 'boule render a/b.toml'?", all},
    {"",
     "a command is missing, expected 'render', 'view', 'pack', 'merge', 'scene', 'trace', 'info' "
     "or 'isa'",
     all},
    {"-o c.png", "option '-o' belongs behind a command, such as 'render'", all},
    {"--rays=r.npy", "option '--rays' belongs behind a command, such as 'trace'", all},
    {"-q render a.toml", "option '-q' belongs behind a command, such as 'render'", all},
    {"--verison", "unknown option '--verison'; did you mean '--version'?", all},
    {"render", "SCENE is missing", of_render},
    {"render a.toml", "-o IMAGE is missing", of_render},
    {"render a.toml b.png", "argument not expected: 'b.png'; is '-o' missing before it?",
     of_render},
    {"render a.toml b.png -o c.png", "argument not expected: 'b.png'", of_render},
    {"render a.toml --out b.png", "unknown option '--out'; did you mean '-o' (--output)?",
     of_render},
    {"render a.toml --outl 2 -o b.png", "unknown option '--outl'; did you mean '--outline'?",
     of_render},
    {"render a.toml --out=b.png", "unknown option '--out'; did you mean '-o' (--output)?",
     of_render},
    {"render --sise 32x32 a.toml -o b.png", "unknown option '--sise'; did you mean '--size'?",
     of_render},
    {"render a.toml -o b.png --max_depth=3",
     "unknown option '--max_depth'; did you mean '--max-depth'?", of_render},
    {"render a.toml -o b.png -size 3x3", "unknown option '-size'; did you mean '--size'?",
     of_render},
    {"render a.toml -o b.png -x", "unknown option '-x'", of_render},
    {"render a.toml -o b.png --spp 1 --spp 4", "--spp is given 2 times", of_render},
    {"render a.toml --quick -o b.png -o c.png -o d.png", "--output is given 3 times", of_render},
    {"render a.toml -o b.png --nonsense", "unknown option '--nonsense'", of_render},
    {"render a.toml -o b.png --spp=x",
     "--spp: 'x' is not understood, expected a whole number from 1 to 2147483647", of_render},
    {"render a.toml -o b.png -q -v", "--quiet excludes --verbose", of_render},
    {"trace a.toml r.npy h.npy",
     "argument not expected: 'r.npy'; is '--rays' or '-o' missing before it?",
     "boule trace --help"},
    {"trace a.toml --rays r.npy", "-o HITS.npy is missing", "boule trace --help"},
    {"info", "SCENE is missing", "boule info --help"},
    {"info a.toml --jsn", "unknown option '--jsn'; did you mean '--json'?", "boule info --help"},
    {"isa more", "argument not expected: 'more'", "boule isa --help"},
};
INSTANTIATE_TEST_SUITE_P(Words, Slips, testing::ValuesIn(slips));

TEST(Help, IsACommandToo) {
  EXPECT_EQ(told("help"), told("--help"));
  for (const std::string command : {"render", "trace", "info", "isa", "help", "version"}) {
    EXPECT_EQ(told("help " + command), told(command + " --help"));
    EXPECT_THAT(told("help"), HasSubstr("\n  " + command + " "));
  }
  EXPECT_EQ(told("version"), told("--version"));
}

TEST(Help, SaysHowACommandIsCalled) {
  EXPECT_THAT(told("--help"), HasSubstr("\nUsage: boule [OPTIONS] COMMAND\n"));
  EXPECT_THAT(told("render --help"), HasSubstr("\nUsage: boule render [OPTIONS] SCENE\n"));
  EXPECT_THAT(told("help trace"), HasSubstr("\nUsage: boule trace [OPTIONS] SCENE\n"));
  EXPECT_THAT(told("info -h"), HasSubstr("\nUsage: boule info [OPTIONS] SCENE\n"));
}

/// The lines of a help text under a heading.
std::string group(const std::string& text, const std::string& heading) {
  const std::string start = "\n\n" + heading + ":\n";
  const std::size_t begin = text.find(start);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find("\n\n", begin + start.size()) - begin);
}

TEST(Help, OptionsStandInGroups) {
  const std::string text = told("help render");
  EXPECT_THAT(text, Not(HasSubstr("\n\n\n")));
  const std::vector<std::pair<std::string, std::vector<std::string>>> groups = {
      {"Picture",
       {"--size", "--spp", "--noise", "--min-spp", "--aa", "--filter", "--seed", "--crop", "--aov",
        "--polygons"}},
      {"Camera and light", {"--method", "--max-depth", "--least-weight", "--exposure"}},
      {"Work", {"--frames", "--skip-existing", "--time-limit", "--partial", "--order", "--tile"}},
      {"Output", {"--output", "--compression", "--progress", "--stats", "--quiet", "--verbose"}},
      {"Machine", {"--isa", "--solver", "--threads"}}};
  std::size_t place = 0;
  for (const auto& [heading, options] : groups) {
    const std::string lines = group(text, heading);
    for (const std::string& option : options) EXPECT_THAT(lines, HasSubstr(option)) << heading;
    EXPECT_GT(text.find("\n" + heading + ":"), place);
    place = text.find("\n" + heading + ":");
  }
}

TEST(Values, SizesAsPeopleTypeThem) {
  for (const char* text : {"32x18", "32X18"}) {
    const auto size = parse_size(text);
    ASSERT_TRUE(size) << text;
    EXPECT_EQ(size->width, 32);
    EXPECT_EQ(size->height, 18);
  }
  for (const char* text : {"32", "x", "32xX18", "32x18X2", "32 x18", "32*18"}) {
    EXPECT_FALSE(parse_size(text)) << text;
  }
}

TEST(Values, EveryFourthFrame) {
  const auto range = parse_frames("1-20:4");
  ASSERT_TRUE(range);
  EXPECT_EQ(range->first, 1);
  EXPECT_EQ(range->last, 20);
  EXPECT_EQ(range->step, 4);
  EXPECT_EQ(range->count(), 5);
  EXPECT_EQ(parse_frames("3-3:7")->count(), 1);
  EXPECT_EQ(parse_frames("0-999999999")->count(), 1'000'000'000);
  EXPECT_EQ(parse_frames("7")->count(), 1);
}

}  // namespace
}  // namespace boule::cli
