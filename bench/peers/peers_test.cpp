// The referee on a small picture: all contenders answer, and Boule's exact ones are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

using nlohmann::json;

json run_referee(const std::string& scenes, const std::string& rays) {
  const TempDir folder;
  const std::string file = (folder.path() / "peers.json").string();
  const ProgramRun run = run_program(
      BOULE_BENCH_PEERS,
      {{"--scenes", scenes, "--rays", rays, "--reps", "1", "--size", "96", "--json", file}, {}});
  EXPECT_EQ(run.exit_code, 0) << run.out << run.err;
  std::ifstream stream(file);
  return json::parse(stream);
}

void expect_sound(const json& row) {
  EXPECT_GT(row["mrays_per_s"].get<double>(), 0) << row;
  EXPECT_GT(row["ratio_to_best_embree"].get<double>(), 0) << row;
  EXPECT_LE(row["min"].get<double>(), row["max"].get<double>()) << row;
  if (row["solver"] == "robust") {
    EXPECT_EQ(row["mismatches"], 0) << row;
  } else {
    EXPECT_LE(row["mismatches"].get<int>(), 20) << row;  // of 9,216 rays, in float
  }
}

TEST(Peers, AnswerEveryKindOfRays) {
  const json report =
      run_referee("u1000", "primary,shadow,mirror,diffuse,light,ambient,orthographic,chord");
  ASSERT_EQ(report["checks"].size(), 8U);
  for (const json& check : report["checks"]) {
    EXPECT_EQ(check["truth_mismatches"], 0) << check;
    EXPECT_EQ(check["sampled"], 4096) << check;
  }
  std::set<std::string> contenders;
  for (const json& row : report["rows"]) {
    expect_sound(row);
    contenders.insert(row["rays"].get<std::string>() + " " + row["contender"].get<std::string>());
  }
  for (const char* rays :
       {"primary", "shadow", "mirror", "diffuse", "light", "ambient", "orthographic", "chord"}) {
    for (const char* name : {"embree-avx2-builtin-8", "embree-avx2-user-16", "boule-avx2"}) {
      EXPECT_THAT(contenders, testing::Contains(std::string(rays) + " " + name));
    }
  }
  EXPECT_FALSE(report["machine"]["cpu"].get<std::string>().empty());
}

/// Balls and sticks, spheres in a cell: scanned capsules and a tree of them.
TEST(Peers, MeetCapsules) {
  const json report = run_referee("sticks24,sticks1000,cell100", "primary,shadow,mirror,diffuse");
  ASSERT_EQ(report["checks"].size(), 12U);
  for (const json& check : report["checks"]) EXPECT_EQ(check["truth_mismatches"], 0) << check;
  for (const json& row : report["rows"]) expect_sound(row);
}

/// Every program that is installed makes the same picture, and all of them are timed.
TEST(Peers, MakeTheSameFrames) {
  const TempDir folder;
  const std::string file = (folder.path() / "frames.json").string();
  const ProgramRun run =
      run_program(BOULE_BENCH_PEERS,
                  {{"--frames", "--scenes", "flake1", "--isa", "avx2", "--reps", "1", "--size",
                    "128", "--json", file, "--pictures", (folder.path() / "kept").string()},
                   {}});
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  std::ifstream stream(file);
  const json report = json::parse(stream);
  ASSERT_EQ(report["frames"].size(), 4U);
  for (const json& row : report["frames"]) {
    const std::string program = row["program"];
    if (row.contains("missing")) {
      EXPECT_THAT(run.out, testing::HasSubstr(program + " "));
      continue;
    }
    EXPECT_EQ(row.contains("difference"), program != "boule-avx2") << row;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "kept" / ("flake1-" + program + ".ppm")));
  }
  ASSERT_EQ(report["scaling"].size(), 1U);
  EXPECT_EQ(report["scaling"][0]["program"], "boule-avx2");
}

TEST(Peers, SayWhoIsNotInstalled) {
  const TempDir empty;
  const ProgramRun run = run_program(BOULE_BENCH_PEERS, {{"--frames", "--scenes", "flake0", "--isa",
                                                          "avx2", "--reps", "1", "--size", "16"},
                                                         {"PATH=" + empty.path().string()}});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("not installed: no program povray"));
  EXPECT_THAT(run.out, testing::HasSubstr("not installed: no program tachyon"));
}

TEST(Peers, RefuseWhatTheyDoNotKnow) {
  for (const char* option : {"--scenes=cornell", "--scenes=sticks23", "--scenes=cell0",
                             "--rays=tertiary", "--isa=avx1024", "--reps=0"}) {
    const ProgramRun run = run_program(BOULE_BENCH_PEERS, {{option, "--size", "8"}, {}});
    EXPECT_EQ(run.exit_code, 2) << option;
    EXPECT_FALSE(run.err.empty()) << option;
  }
  for (const char* option : {"--scenes=u1000", "--rays=primary", "--isa=avx1024"}) {
    const ProgramRun run = run_program(BOULE_BENCH_PEERS, {{"--frames", option}, {}});
    EXPECT_EQ(run.exit_code, 2) << option;
  }
}

}  // namespace
}  // namespace boule::test
