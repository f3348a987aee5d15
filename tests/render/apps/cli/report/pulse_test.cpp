// The thread that tells the time, and what must not depend on having it.
#include "render/apps/cli/process/pulse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <future>
#include <thread>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/reading_limit.h"
#include "render/apps/cli/process/standard_error.h"
#include "render/apps/cli/report/live_report.h"

namespace boule::cli {
namespace {

using Clock = Pulse::Clock;
constexpr auto never = Clock::time_point::max();
constexpr std::chrono::minutes generous{5};

TEST(Pulse, BeatsWhenItIsAskedTo) {
  std::promise<Clock::time_point> beaten;
  Pulse pulse([&](Clock::time_point now) {
    beaten.set_value(now);
    return never;
  });
  const auto when = Clock::now() + std::chrono::milliseconds(5);
  pulse.at(when);
  auto future = beaten.get_future();
  ASSERT_EQ(future.wait_for(generous), std::future_status::ready);
  EXPECT_GE(future.get(), when);
}

TEST(Pulse, BeatsAgainWhenTheBeatAsks) {
  std::promise<void> fifth;
  int beats = 0;
  Pulse pulse([&](Clock::time_point now) {
    if (++beats == 5) fifth.set_value();
    return beats < 5 ? now + std::chrono::milliseconds(1) : never;
  });
  pulse.at(Clock::now());
  ASSERT_EQ(fifth.get_future().wait_for(generous), std::future_status::ready);
}

/// What was asked for later than what it waits for already is not lost: the beat decides.
TEST(Pulse, AnEarlierTimeComesFirst) {
  std::promise<void> beaten;
  Pulse pulse([&](Clock::time_point) {
    beaten.set_value();
    return never;
  });
  pulse.at(Clock::now() + std::chrono::hours(24));
  pulse.at(Clock::now());
  ASSERT_EQ(beaten.get_future().wait_for(generous), std::future_status::ready);
}

TEST(Pulse, EndsWithoutAnUnawaitedBeat) {
  std::atomic<int> beats{0};
  {
    Pulse pulse([&](Clock::time_point) {
      ++beats;
      return never;
    });
    pulse.at(Clock::now() + std::chrono::hours(24));
  }
  EXPECT_EQ(beats, 0);
}

/// A signal that is the program's lands on its threads, not on this one.
TEST(Pulse, NoSignalReachesIt) {
  std::promise<sigset_t> mask;
  Pulse pulse([&](Clock::time_point) {
    sigset_t blocked{};
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    mask.set_value(blocked);
    return never;
  });
  pulse.at(Clock::now());
  auto future = mask.get_future();
  ASSERT_EQ(future.wait_for(generous), std::future_status::ready);
  const sigset_t blocked = future.get();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) {
    EXPECT_EQ(sigismember(&blocked, signal), 1) << signal;
  }
  sigset_t own{};
  pthread_sigmask(SIG_SETMASK, nullptr, &own);
  EXPECT_EQ(sigismember(&own, SIGTERM), 0);
}

RenderCommand quiet_command() {
  RenderCommand command;
  command.verbosity = Verbosity::quiet;
  return command;
}

/// Nothing but the pulse raises the flag here.
TEST(TimeLimit, RaisesTheFlagWhileNothingIsReported) {
  const StopGuard guard(OnSignal::leave);
  LiveReport live(quiet_command());
  live.start_time_limit(0.001);
  const auto end = Clock::now() + generous;
  while (!StopGuard::flag() && Clock::now() < end) std::this_thread::yield();
  EXPECT_TRUE(StopGuard::flag());
}

TEST(TimeLimit, IsOverWithWhatItLimits) {
  const StopGuard guard(OnSignal::leave);
  LiveReport live(quiet_command());
  live.start_time_limit(1e9);
  live.end_time_limit();
  live.update({0.5, 1});
  EXPECT_FALSE(StopGuard::flag());
}

/// Reading hangs for good; what ends it is the limit.
TEST(LoadLimitDeathTest, EndsAReadThatNeverReturns) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto hang = [] {
    ReadingLimit limit(0.001);
    const ReadingLimit::Reading reading(limit, "x.toml");
    for (;;) ::pause();
  };
  EXPECT_EXIT(hang(), testing::ExitedWithCode(1),
              "^boule: error: reading 'x.toml' took longer than --load-limit 0.001 s\n$");
}

/// Any reading takes longer than a nanosecond.
TEST(LoadLimitDeathTest, CountsAllThatIsRead) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto read = [] {
    ReadingLimit limit(1e-9);
    { const ReadingLimit::Reading reading(limit, "x.toml"); }
  };
  EXPECT_EXIT(read(), testing::ExitedWithCode(1), "reading 'x.toml' took longer");
}

TEST(LoadLimit, NoneIsNone) {
  ReadingLimit limit(std::nullopt);
  const ReadingLimit::Reading reading(limit, "x.toml");
}

/// Whoever draws, on whatever thread: nothing follows it.
TEST(LastLineDeathTest, NothingFollowsIt) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto leave = [] {
    draw_line("boule:  42 %");
    write_last_line("the last line\n");
    std::thread([] {
      draw_line("boule:  43 %");
      write_lines("late\n");
    }).join();
    ::_exit(3);
  };
  EXPECT_EXIT(leave(), testing::ExitedWithCode(3), "^\rboule:  42 %\nthe last line\n$");
}

TEST(LastLineDeathTest, TheFirstWhoLeavesWins) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto leave = [] {
    std::thread other([] { leave_at_once("one of two\n", 3); });
    leave_at_once("one of two\n", 3);
  };
  EXPECT_EXIT(leave(), testing::ExitedWithCode(3), "^one of two\n$");
}

}  // namespace
}  // namespace boule::cli
