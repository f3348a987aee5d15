// What is told of a run and when, by a clock that the test drives.
#include "render/apps/cli/report/progress_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace boule::cli {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Looks at the bar every 10 ms from `begin` to `end`, as callbacks do, or, more rarely, when it
/// asked to be looked at.
struct Told {
  double at;
  std::string text;
};
std::vector<Told> watch(ProgressBar& bar, double begin, double end) {
  std::vector<Told> told;
  const int first = static_cast<int>(std::lround(begin * 100));
  const int last = static_cast<int>(std::lround(end * 100));
  for (int i = first; i <= last; ++i) {
    const double now = i / 100.0;
    if (auto text = bar.tell(now)) told.push_back({now, *text});
  }
  return told;
}

/// A pass that takes `seconds` and moves evenly, a hundred updates a second.
std::vector<Told> run_pass(ProgressBar& bar, double begin, double seconds) {
  std::vector<Told> told;
  bar.start_pass("pixels", begin);
  const int steps = static_cast<int>(std::lround(seconds * 100));
  for (int i = 1; i <= steps; ++i) {
    const double now = begin + i / 100.0;
    const double share = static_cast<double>(i) / steps;
    bar.update({share, static_cast<std::uint64_t>(i) * 10'000}, now);
    if (auto text = bar.tell(now)) told.push_back({now, *text});
  }
  bar.end_pass();
  return told;
}

std::vector<double> times_of(const std::vector<Told>& told) {
  std::vector<double> times;
  times.reserve(told.size());
  for (const Told& one : told) times.push_back(std::round(one.at * 100) / 100);
  return times;
}

TEST(PlainProgress, AShortRunIsSilent) {
  ProgressBar bar(ProgressStyle::plain);
  bar.start_stage("reading a.toml", 0);
  EXPECT_THAT(watch(bar, 0, 0.5), IsEmpty());
  EXPECT_THAT(run_pass(bar, 0.5, 1.49), IsEmpty());
  bar.start_stage("writing a.png", 1.99);
  EXPECT_THAT(watch(bar, 1.99, 3.98), IsEmpty());
}

TEST(PlainProgress, FirstLineComesAfterTwoSeconds) {
  ProgressBar bar(ProgressStyle::plain);
  const auto told = run_pass(bar, 0, 4);
  ASSERT_THAT(times_of(told), ElementsAre(2, 4));
  EXPECT_EQ(told[0].text, "boule:  50 %, 2.0 s elapsed, 2.0 s left, 1.0 Mray/s");
  EXPECT_EQ(told[1].text, "boule: 100 %, 4.0 s elapsed, 0.0 s left, 1.0 Mray/s");
}

TEST(PlainProgress, RatesAreOfWhatIsCounted) {
  using Names = std::pair<const char*, std::string>;
  for (const auto& [of_what, rate] : {Names("points", ", 1.0 Mpoint/s"), Names("spheres", "")}) {
    ProgressBar bar(ProgressStyle::plain), json(ProgressStyle::json);
    for (ProgressBar* one : {&bar, &json}) {
      one->start_pass(of_what, 0);
      one->update({0.5, 2'000'000}, 2);
    }
    EXPECT_EQ(bar.tell(2).value_or(""), "boule:  50 %, 2.0 s elapsed, 2.0 s left" + rate);
    const auto told = nlohmann::json::parse(json.tell(2).value_or(""));
    EXPECT_EQ(told.value("mpoints_per_s", 0.0), rate.empty() ? 0 : 1);
    EXPECT_FALSE(told.contains("mrays_per_s"));
  }
}

/// The two seconds are those of the run, not of the pass.
TEST(PlainProgress, ReadingCountsForTheTwoSeconds) {
  ProgressBar bar(ProgressStyle::plain);
  bar.start_stage("reading a.toml", 0);
  EXPECT_THAT(watch(bar, 0, 1.5), IsEmpty());
  EXPECT_THAT(times_of(run_pass(bar, 1.5, 1)), ElementsAre(2, 2.5));
}

/// 10 s are 4 % of it: the per cents come later.
TEST(PlainProgress, LongRunsPrintEveryTenPerCent) {
  ProgressBar bar(ProgressStyle::plain);
  const auto told = run_pass(bar, 0, 250);
  EXPECT_THAT(times_of(told), ElementsAre(2, 27, 52, 77, 102, 127, 152, 177, 202, 227, 250));
  for (std::size_t i = 0; i + 1 < told.size(); ++i) {
    EXPECT_EQ(std::stoul(told[i].text.substr(7)), i * 10) << told[i].text;
  }
}

/// 10 s are 25 % of it: they come later.
TEST(PlainProgress, ShorterRunsPrintEveryTenSeconds) {
  ProgressBar bar(ProgressStyle::plain);
  EXPECT_THAT(times_of(run_pass(bar, 0, 40)), ElementsAre(2, 12, 22, 32, 40));
}

TEST(PlainProgress, StagesPrintAfterTwoAndTenSeconds) {
  ProgressBar bar(ProgressStyle::plain);
  bar.start_stage("reading a.toml", 0);
  const auto told = watch(bar, 0, 31);
  EXPECT_THAT(times_of(told), ElementsAre(2, 12, 22));
  EXPECT_EQ(told[0].text, "boule: reading a.toml ...");
  bar.start_stage("preparing a.toml", 31);
  EXPECT_THAT(times_of(watch(bar, 31, 33)), ElementsAre(33));
}

/// Of whatever kind they are.
TEST(PlainProgress, TenSecondsLieBetweenLines) {
  ProgressBar bar(ProgressStyle::plain);
  bar.start_stage("reading a.toml", 0);
  EXPECT_THAT(times_of(watch(bar, 0, 3)), ElementsAre(2));
  bar.start_stage("preparing a.toml", 3);
  EXPECT_THAT(watch(bar, 3, 9), IsEmpty());
  EXPECT_THAT(times_of(run_pass(bar, 9, 8)), ElementsAre(12, 17));
}

TEST(PlainProgress, WhatItWaitsForIsSaid) {
  ProgressBar bar(ProgressStyle::plain);
  bar.start_pass("rays", 0);
  const auto told = watch(bar, 0, 100);
  ASSERT_THAT(times_of(told), ElementsAre(2));  // then no per cent moves
  EXPECT_EQ(told[0].text, "boule:   0 %, 2.0 s elapsed, waiting for the first block of rays");
}

TEST(BarProgress, ItsClockGoesOnWhileNothingMoves) {
  ProgressBar bar(ProgressStyle::bar);
  bar.start_pass("pixels", 1);
  EXPECT_THAT(watch(bar, 1, 2.99), IsEmpty());
  const auto first = watch(bar, 3, 63);
  ASSERT_GE(first.size(), 500u);
  EXPECT_EQ(first[0].text,
            "boule:   0 % [........] 2.0 s elapsed, waiting for the first block of pixels");
  EXPECT_THAT(first.back().text, HasSubstr("] 1:01 elapsed, waiting for the first block"));

  bar.update({0.5, 1'000'000, 3}, 63);
  const auto moving = watch(bar, 63, 64.99);
  ASSERT_FALSE(moving.empty());
  EXPECT_THAT(moving.back().text, EndsWith("] 1:03 elapsed, 1:03 left, 0.0 Mray/s"));
  const auto standing = watch(bar, 65, 123);
  ASSERT_FALSE(standing.empty());
  EXPECT_EQ(standing[0].text,
            "boule:  50 % [####....] 1:04 elapsed, 1:04 left, waiting for 3 blocks of pixels");
  EXPECT_THAT(standing.back().text, HasSubstr("2:0"));
  bar.update({0.75, 2'000'000, 1}, 123);
  EXPECT_THAT(watch(bar, 123, 123.2).back().text, EndsWith(" Mray/s"));
  EXPECT_THAT(watch(bar, 125, 126)[0].text, EndsWith("waiting for 1 block of pixels"));
}

TEST(BarProgress, DrawnTenTimesASecondAndLast) {
  ProgressBar bar(ProgressStyle::bar);
  const auto told = run_pass(bar, 0, 1);
  EXPECT_LE(told.size(), 11u);
  EXPECT_GE(told.size(), 9u);
  EXPECT_NEAR(told[0].at, 0.01, 1e-9);
  EXPECT_THAT(told.back().text, testing::StartsWith("boule: 100 % [####################] 1.0"));
  EXPECT_THAT(watch(bar, 1, 100), IsEmpty());
}

TEST(BarProgress, StageClockEndsWithItsStage) {
  ProgressBar bar(ProgressStyle::bar);
  bar.start_stage("reading a.toml", 0);
  EXPECT_THAT(watch(bar, 0, 1.99), IsEmpty());
  const auto reading = watch(bar, 2, 3);
  ASSERT_GE(reading.size(), 9u);
  EXPECT_EQ(reading[0].text, "boule: reading a.toml ... 2.0 s");
  bar.start_stage("preparing a.toml", 3);
  EXPECT_THAT(watch(bar, 3, 3.2)[0].text, testing::StartsWith("boule: preparing a.toml ... 0."));
}

/// A late word from another thread does not turn it back.
TEST(BarProgress, ItNeverGoesBack) {
  ProgressBar bar(ProgressStyle::bar);
  bar.start_pass("pixels", 0);
  bar.update({0.5, 100}, 1);
  EXPECT_THAT(bar.tell(1).value_or(""), HasSubstr(" 50 %"));
  bar.update({0.25, 50}, 2);
  EXPECT_THAT(bar.tell(2).value_or(""), HasSubstr(" 50 %"));
}

TEST(BarProgress, NextIsWhenSomethingChanges) {
  ProgressBar bar(ProgressStyle::bar);
  EXPECT_TRUE(std::isinf(bar.next()));
  bar.start_stage("reading a.toml", 1);
  EXPECT_EQ(bar.next(), 3);
  EXPECT_FALSE(bar.tell(2.999));
  EXPECT_TRUE(bar.tell(3));
  EXPECT_DOUBLE_EQ(bar.next(), 3.1);
}

TEST(JsonProgress, TenObjectsASecondAndOneMore) {
  ProgressBar bar(ProgressStyle::json);
  bar.start_stage("reading a.toml", 0);
  EXPECT_THAT(watch(bar, 0, 30), IsEmpty());
  const auto told = run_pass(bar, 30, 1);
  EXPECT_GE(told.size(), 9u);
  EXPECT_LE(told.size(), 11u);
  for (const Told& one : told) {
    const auto json = nlohmann::json::parse(one.text);
    EXPECT_EQ(json.size(), 4u) << one.text;
    EXPECT_NEAR(json.at("elapsed_s").get<double>(), one.at - 30, 1e-3);
  }
  EXPECT_EQ(nlohmann::json::parse(told.back().text).at("share"), 1);
}

class SeriesProgress : public testing::Test {
 protected:
  /// A frame of `seconds`, of which half is rendering.
  static std::vector<Told> run_frame(ProgressBar& bar, double begin, double seconds) {
    bar.start_frame();
    bar.start_stage("reading a.toml", begin);
    auto told = watch(bar, begin, begin + seconds / 2);
    const auto pass = run_pass(bar, begin + seconds / 2, seconds / 2);
    told.insert(told.end(), pass.begin(), pass.end());
    return told;
  }
};

TEST_F(SeriesProgress, TwentyTinyFramesSayNothing) {
  ProgressBar bar(ProgressStyle::plain, 20);
  for (int i = 0; i < 20; ++i) EXPECT_THAT(run_frame(bar, i * 0.1, 0.1), IsEmpty());
}

TEST_F(SeriesProgress, LinesAreThoseOfTheWhole) {
  ProgressBar bar(ProgressStyle::plain, 20);
  std::vector<Told> told;
  for (int i = 0; i < 20; ++i) {
    for (const Told& one : run_frame(bar, i, 1)) told.push_back(one);
  }
  ASSERT_THAT(times_of(told), ElementsAre(2, 12, 20));
  EXPECT_THAT(told[0].text,
              testing::StartsWith("boule:  10 %, frame 2 of 20, 2.0 s elapsed, 18.0 s left, "));
  EXPECT_THAT(told[2].text, HasSubstr("boule: 100 %, frame 20 of 20, 20.0 s elapsed, 0.0 s left"));
}

TEST_F(SeriesProgress, TheBarSpansAllFrames) {
  ProgressBar bar(ProgressStyle::bar, 4);
  run_frame(bar, 0, 10);
  run_frame(bar, 10, 10);
  bar.start_frame();
  bar.start_pass("pixels", 20);
  bar.update({0.5, 1'000'000}, 25);
  EXPECT_EQ(bar.tell(25).value_or(""),
            "boule:  62 % [#####...] frame 3 of 4, 25.0 s elapsed, 15.0 s left, 0.2 Mray/s");
  bar.end_pass();
  bar.start_stage("writing c.png", 25);
  EXPECT_THAT(bar.tell(27).value_or(""), EndsWith("27.0 s elapsed, 16.2 s left, writing c.png"));
}

/// They took no time, and tell nothing of those that will.
TEST_F(SeriesProgress, SkippedFramesDoNotShortenTheEstimate) {
  ProgressBar bar(ProgressStyle::bar, 4);
  for (int i = 0; i < 2; ++i) {
    bar.start_frame();
    bar.skip_frame();
  }
  run_frame(bar, 0, 10);
  bar.start_frame();
  bar.start_pass("pixels", 10);
  EXPECT_THAT(bar.tell(10.5).value_or(""),
              HasSubstr("75 % [######..] frame 4 of 4, 10.5 s elapsed, 10.5 s left"));
}

/// 80 columns hold it, as long as neither takes a day.
TEST_F(SeriesProgress, ItFitsATerminal) {
  ProgressBar bar(ProgressStyle::bar, 99);
  for (int i = 0; i < 12; ++i) run_frame(bar, i * 3000.0, 3000);
  bar.start_frame();
  bar.start_pass("pixels", 36000);
  bar.update({0.5, std::uint64_t{1} << 40}, 38000);
  const std::string line = bar.tell(38000).value_or("");
  EXPECT_THAT(line, EndsWith(" % frame 13 of 99, 10:33:20 elapsed, 73:02:40 left, 549.8 Mray/s"));
  EXPECT_LE(line.size(), 79u) << line;
}

/// The same where noise is measured: samples stand in place of rays.
TEST_F(SeriesProgress, ItFitsATerminalWithNoise) {
  ProgressBar bar(ProgressStyle::bar, 99);
  for (int i = 0; i < 12; ++i) run_frame(bar, i * 3000.0, 3000);
  bar.start_frame();
  bar.start_pass("pixels", 36000);
  bar.update({0.5, std::uint64_t{1} << 40, 2, {1000, 4'096'000, 10}}, 38000);
  const std::string line = bar.tell(38000).value_or("");
  EXPECT_THAT(line, EndsWith("frame 13 of 99, 10:33:20 elapsed, 73:02:40 left, 4096.0 spp"));
  EXPECT_LE(line.size(), 79u) << line;
}

/// Until a pixel is finished nothing is known of samples.
TEST(NoiseProgress, TellsTheSamplesOfFinishedPixels) {
  ProgressBar bar(ProgressStyle::bar);
  bar.start_pass("pixels", 0);
  bar.update({0.25, 10'000'000, 2, {}}, 5);
  EXPECT_THAT(bar.tell(5).value_or(""), EndsWith("5.0 s elapsed, 15.0 s left, 2.0 Mray/s"));
  bar.update({0.5, 20'000'000, 2, {400, 15'280, 399}}, 10);
  const std::string line = bar.tell(10).value_or("");
  EXPECT_THAT(line, EndsWith("10.0 s elapsed, 10.0 s left, 38.2 spp, 99 % settled"));
  EXPECT_LE(line.size(), 79u) << line;
}

/// What a checkpoint held took none of this run's time.
TEST(ResumedProgress, EstimateCoversTheRest) {
  ProgressBar bar(ProgressStyle::bar);
  bar.start_pass("pixels", 0);
  bar.update({.share = 0.6, .rays = 10'000'000, .resumed = 0.5}, 5);
  EXPECT_THAT(bar.tell(5).value_or(""), HasSubstr(" 60 % "));
  EXPECT_THAT(bar.tell(5.2).value_or(""), HasSubstr("5.2 s elapsed, 20.8 s left"));
}

TEST(NoiseProgress, JsonHasItWhenPixelsAreFinished) {
  ProgressBar bar(ProgressStyle::json);
  bar.start_pass("pixels", 0);
  bar.update({0.25, 10'000'000, 2, {}}, 5);
  EXPECT_EQ(nlohmann::json::parse(bar.tell(5).value_or("{}")).size(), 4u);
  bar.update({0.5, 20'000'000, 2, {400, 15'280, 399}}, 10);
  const auto json = nlohmann::json::parse(bar.tell(10).value_or("{}"));
  EXPECT_EQ(json.at("mean_spp"), 38.2);
  EXPECT_EQ(json.at("settled"), 0.9975);
  EXPECT_EQ(json.size(), 6u);
}

TEST_F(SeriesProgress, JsonExtendsThatOfTheFrame) {
  ProgressBar bar(ProgressStyle::json, 4);
  run_frame(bar, 0, 10);
  bar.start_frame();
  bar.start_pass("pixels", 15);
  bar.update({0.25, 1'000'000}, 20);
  const auto json = nlohmann::json::parse(bar.tell(20).value_or("{}"));
  EXPECT_EQ(json.at("share"), 0.25);
  EXPECT_EQ(json.at("elapsed_s"), 5);
  EXPECT_EQ(json.at("remaining_s"), 15);
  EXPECT_EQ(json.at("mrays_per_s"), 0.2);
  EXPECT_EQ(json.at("frame"), 2);
  EXPECT_EQ(json.at("frames"), 4);
  EXPECT_EQ(json.at("series_remaining_s"), 44);
  EXPECT_EQ(json.size(), 7u);
}

}  // namespace
}  // namespace boule::cli
