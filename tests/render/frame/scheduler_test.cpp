#include "render/frame/scheduler.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cfenv>
#include <limits>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

namespace boule {
namespace {

TEST(Scheduler, CallsEveryIndexOnce) {
  for (const unsigned threads : {1u, 2u, 7u}) {
    for (const std::size_t count : {0, 1, 3, 1000}) {
      Scheduler scheduler(threads);
      ASSERT_EQ(scheduler.workers(), threads);
      std::vector<std::atomic<int>> calls(count);
      std::atomic<bool> worker_out_of_range{false};
      const Status status = scheduler.run(count, [&](unsigned worker, std::size_t index) {
        ++calls[index];
        if (worker >= threads) worker_out_of_range = true;
      });
      EXPECT_TRUE(status);
      EXPECT_FALSE(worker_out_of_range);
      for (const auto& c : calls) EXPECT_EQ(c, 1);
    }
  }
}

TEST(Scheduler, WorkersDoOneIndexAtATime) {
  Scheduler scheduler(4);
  std::vector<std::atomic<int>> inside(4);
  std::atomic<int> collisions{0};
  EXPECT_TRUE(scheduler.run(2000, [&](unsigned worker, std::size_t) {
    if (inside[worker]++ != 0) ++collisions;
    --inside[worker];
  }));
  EXPECT_EQ(collisions, 0);
}

TEST(Scheduler, WorkerZeroIsTheCaller) {
  Scheduler scheduler(3);
  const auto caller = std::this_thread::get_id();
  std::atomic<int> strangers{0};
  EXPECT_TRUE(scheduler.run(500, [&](unsigned worker, std::size_t) {
    if ((worker == 0) != (std::this_thread::get_id() == caller)) ++strangers;
  }));
  EXPECT_EQ(strangers, 0);
}

TEST(Scheduler, ZeroThreadsMeansHardwareThreads) {
  EXPECT_GE(Scheduler(0).workers(), 1u);
  EXPECT_EQ(Scheduler(4000000000u).workers(), Scheduler::max_workers);
}

/// A loop of so many indices ends only if it is stopped. Without that it would reach
/// `far_too_many`, but no worker gets there just because another one is kept from running.
constexpr std::size_t endless = std::numeric_limits<std::size_t>::max() / 2;
constexpr std::size_t far_too_many = 10'000'000'000;

TEST(Scheduler, ExceptionsBecomeDiagnostics) {
  for (const unsigned threads : {1u, 3u}) {
    Scheduler scheduler(threads);
    std::atomic<std::size_t> calls{0};
    const Status status = scheduler.run(endless, [&](unsigned, std::size_t index) {
      ++calls;
      if (index == 5) throw std::runtime_error("broken block");
      if (index == far_too_many) throw std::runtime_error("not stopped");
    });
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "broken block");
    EXPECT_GE(calls, 6u);
  }
  const Status memory = Scheduler(1).run(1, [](unsigned, std::size_t) { throw std::bad_alloc(); });
  ASSERT_FALSE(memory);
  EXPECT_EQ(memory.error().message, "out of memory");
  EXPECT_FALSE(Scheduler(2).run(3, [](unsigned, std::size_t) { throw 1; }));
}

TEST(Scheduler, CancelStopsItWithoutAnError) {
  Scheduler scheduler(2);
  std::atomic<bool> cancel{false};
  std::atomic<std::size_t> calls{0};
  const auto body = [&](unsigned, std::size_t index) {
    ++calls;
    if (index == 10) cancel = true;
    if (index == far_too_many) throw std::runtime_error("not stopped");
  };
  EXPECT_TRUE(scheduler.run(endless, body, &cancel));
  EXPECT_GE(calls, 11u);
  const std::size_t before = calls;
  EXPECT_TRUE(scheduler.run(10, body, &cancel));
  EXPECT_EQ(calls, before);
}

TEST(Scheduler, ParallelForPassesExceptionsOn) {
  Scheduler scheduler(3);
  const ParallelFor parallel_for = scheduler.parallel_for();
  std::vector<std::atomic<int>> calls(100);
  parallel_for(100, [&](std::size_t i) { ++calls[i]; });
  for (const auto& c : calls) EXPECT_EQ(c, 1);
  EXPECT_THROW(parallel_for(10, [](std::size_t) { throw std::bad_alloc(); }), std::bad_alloc);
}

TEST(Scheduler, CancelledParallelForThrows) {
  Scheduler scheduler(2);
  std::atomic<bool> cancel{false};
  const ParallelFor parallel_for = scheduler.parallel_for(&cancel);
  std::atomic<int> calls{0};
  parallel_for(100, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 100);
  const auto body = [&](std::size_t index) {
    if (index == 10) cancel = true;
    if (index == far_too_many) throw std::bad_alloc();
  };
  EXPECT_THROW(parallel_for(endless, body), std::runtime_error);
  EXPECT_THROW(parallel_for(1, [](std::size_t) {}), std::runtime_error);
}

TEST(Scheduler, WorkersUseTheDefaultFloatEnvironment) {
  Scheduler scheduler(3);
  std::atomic<int> wrong{0};
  std::fesetround(FE_UPWARD);
  const Status status = scheduler.run(100, [&](unsigned, std::size_t) {
    if (std::fegetround() != FE_TONEAREST) ++wrong;
  });
  const int after = std::fegetround();
  std::fesetround(FE_TONEAREST);
  EXPECT_TRUE(status);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(after, FE_UPWARD);
}

/// While it lives, no thread can be started, because its stack does not fit into memory.
class NoMoreThreads {
 public:
  NoMoreThreads() {
    pthread_getattr_default_np(&saved_);
    pthread_attr_t impossible;
    pthread_attr_init(&impossible);
    pthread_attr_setstacksize(&impossible, std::size_t{1} << 50);
    set_ = pthread_setattr_default_np(&impossible) == 0;
    pthread_attr_destroy(&impossible);
  }
  ~NoMoreThreads() { pthread_setattr_default_np(&saved_); }
  [[nodiscard]] bool holds() const { return set_; }

 private:
  pthread_attr_t saved_{};
  bool set_ = false;
};

TEST(Scheduler, RunsWithFewerThreadsWhereRefused) {
  Scheduler scheduler(8);
  std::vector<std::atomic<int>> calls(100);
  const auto body = [&](unsigned, std::size_t i) { ++calls[i]; };
  {
    const NoMoreThreads limit;
    ASSERT_TRUE(limit.holds());
    EXPECT_TRUE(scheduler.run(100, body));
    EXPECT_EQ(scheduler.threads_used(), 1u);
  }
  for (const auto& c : calls) EXPECT_EQ(c, 1);
  EXPECT_TRUE(scheduler.run(100, body));
  EXPECT_EQ(scheduler.threads_used(), 8u);
}

}  // namespace
}  // namespace boule
