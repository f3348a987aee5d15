#include <nlohmann/json.hpp>

#include "simd/dispatch/dispatch.h"
#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Program, HelpGoesToStandardOutput) {
  for (const char* flag : {"--help", "-h"}) {
    const ProgramRun run = boule_run({flag});
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_THAT(run.out, HasSubstr("render"));
    EXPECT_THAT(run.out, HasSubstr("isa"));
    EXPECT_THAT(run.out, HasSubstr("info"));
    EXPECT_THAT(run.err, IsEmpty());
  }
}

TEST(Program, HelpOfRenderNamesEveryOption) {
  const ProgramRun run = boule_run({"render", "--help"});
  EXPECT_EQ(run.exit_code, 0);
  for (const char* option :
       {"--output", "--size",    "--spp",      "--seed",        "--max-depth", "--isa",
        "--solver", "--threads", "--tile",     "--compression", "--polygons",  "--quiet",
        "--crop",   "--order",   "--exposure", "--method",      "--aov",       "--progress",
        "--stats",  "--verbose", "--filter"}) {
    EXPECT_THAT(run.out, HasSubstr(option));
  }
}

TEST(Program, VersionIsOneLine) {
  const ProgramRun run = boule_run({"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, StartsWith("boule "));
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1);
}

TEST(Program, IsaListsWhatTheLibraryLists) {
  const ProgramRun run = boule_run({"isa"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, IsEmpty());
  for (const IsaInfo& info : list_isas()) EXPECT_THAT(run.out, HasSubstr(std::string(info.name)));
  EXPECT_THAT(run.out, HasSubstr("selected"));
}

TEST(Program, IsaJsonFollowsTheEnvironment) {
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    const ProgramRun run = boule_run({"isa", "--json"}, {"BOULE_ISA=" + std::string(info.name)});
    ASSERT_EQ(run.exit_code, 0);
    const auto list = nlohmann::json::parse(run.out);
    ASSERT_EQ(list.size(), list_isas().size());
    for (const auto& entry : list) {
      EXPECT_EQ(entry["selected"].get<bool>(), entry["name"] == std::string(info.name));
      EXPECT_GE(entry["width"].get<int>(), 1);
      EXPECT_TRUE(entry["supported"].is_boolean());
    }
  }
}

}  // namespace
}  // namespace boule::test
