#include "render/threads/threads.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "render/threads/cpu_quota.h"
#include "render/threads/waiting_thread.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

/// The kernel's names of `count` threads that run at once.
std::set<pid_t> run_together(std::size_t count) {
  std::vector<pid_t> names(count);
  std::atomic<std::size_t> running{0};
  {
    const Threads threads(count, [&](std::size_t index) {
      names[index] = gettid();
      ++running;
      while (running < count) std::this_thread::yield();
    });
    EXPECT_EQ(threads.size(), count);
    if (threads.size() < count) running = count;
  }
  return {names.begin(), names.end()};
}

TEST(Threads, AreReusedByTheNextLoop) {
  const std::size_t count = WaitingThread::most_waiting();
  Threads::prepare(count);
  const std::set<pid_t> first = run_together(count);
  EXPECT_EQ(first.size(), count);
  EXPECT_EQ(first.count(gettid()), 0u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(run_together(count), first);
}

TEST(Threads, BeyondTheHardwaresNumberEnd) {
  const std::size_t count = WaitingThread::most_waiting() + 3;
  const std::set<pid_t> first = run_together(count);
  EXPECT_EQ(first.size(), count);
  const std::set<pid_t> second = run_together(count);
  std::vector<pid_t> both;
  std::set_intersection(first.begin(), first.end(), second.begin(), second.end(),
                        std::back_inserter(both));
  EXPECT_EQ(both.size(), WaitingThread::most_waiting());
}

TEST(Threads, ConcurrentCallersGetDifferentThreads) {
  std::atomic<int> calls{0};
  const auto use_often = [&calls] {
    for (int i = 0; i < 200; ++i) {
      std::atomic<int> own{0};
      std::size_t size = 0;
      {
        const Threads threads(2, [&own](std::size_t) { ++own; });
        size = threads.size();
      }
      if (own == static_cast<int>(size)) ++calls;
    }
  };
  std::thread a(use_often), b(use_often), c(use_often);
  a.join();
  b.join();
  c.join();
  EXPECT_EQ(calls, 600);
}

TEST(Threads, LargerStacksNeedNewThreads) {
  const std::set<pid_t> small = run_together(1);
  pthread_attr_t saved{}, larger{};
  pthread_getattr_default_np(&saved);
  pthread_attr_init(&larger);
  constexpr std::size_t stack = std::size_t{64} << 20;
  pthread_attr_setstacksize(&larger, stack);
  ASSERT_EQ(pthread_setattr_default_np(&larger), 0);
  std::atomic<std::size_t> has{0};
  std::atomic<pid_t> name{0};
  {
    const Threads one(1, [&](std::size_t) {
      pthread_attr_t own{};
      std::size_t size = 0;
      pthread_getattr_np(pthread_self(), &own);
      pthread_attr_getstacksize(&own, &size);
      pthread_attr_destroy(&own);
      has = size;
      name = gettid();
    });
  }
  pthread_setattr_default_np(&saved);
  pthread_attr_destroy(&larger);
  EXPECT_GE(has, stack);
  EXPECT_EQ(small.count(name), 0u);
}

TEST(Threads, WaitingThreadsAreNotCountedTwice) {
  Threads::prepare(WaitingThread::most_waiting());
  const std::set<pid_t> before = run_together(WaitingThread::most_waiting());
  EXPECT_TRUE(can_start_threads(5));
  EXPECT_EQ(run_together(WaitingThread::most_waiting()), before);
}

TEST(Threads, ForkedChildrenGetTheirOwn) {
  Threads::prepare(WaitingThread::most_waiting());
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);  // it would wait for ever for a thread of its parent
    std::atomic<int> calls{0};
    for (int i = 0; i < 10; ++i) {
      const Threads threads(2, [&calls](std::size_t) { ++calls; });
    }
    _exit(calls == 20 ? 0 : 1);
  }
  ASSERT_GT(child, 0);
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

/// A folder of control groups as the kernel shows it.
class Quotas : public testing::Test {
 protected:
  void file(const std::string& name, const std::string& text) const {
    const auto path = folder_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    test::write_bytes(path, text);
  }
  unsigned threads(const std::string& groups) const {
    return quota_threads(groups, folder_.path().string());
  }

 private:
  test::TempDir folder_;
};

TEST_F(Quotas, OfVersionTwoTheTightestCounts) {
  file("a/cpu.max", "400000 100000\n");
  file("a/b/cpu.max", "max 100000\n");
  EXPECT_EQ(threads("0::/a/b\n"), 4U);
  file("a/b/cpu.max", "150000 100000\n");
  EXPECT_EQ(threads("0::/a/b\n"), 2U);  // rounded up
  EXPECT_EQ(threads("0::/a\n"), 4U);
  EXPECT_EQ(threads("0::/c\n"), 0U);
  file("cpu.max", "50000 100000\n");  // a container's own
  EXPECT_EQ(threads("0::/\n"), 1U);
  EXPECT_EQ(threads("0::/outside/name\n"), 1U);
}

TEST_F(Quotas, OfVersionOneToo) {
  const std::string groups = "12:memory:/x\n4:cpu,cpuacct:/x\n3:cpuset:/x\n0::/y\n";
  EXPECT_EQ(threads(groups), 0U);
  file("cpu,cpuacct/x/cpu.cfs_quota_us", "-1\n");
  file("cpu,cpuacct/x/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(threads(groups), 0U);
  file("cpu,cpuacct/x/cpu.cfs_quota_us", "300000\n");
  EXPECT_EQ(threads(groups), 3U);
  file("cpu,cpuacct/cpu.cfs_quota_us", "100000\n");
  file("cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(threads(groups), 1U);
  EXPECT_EQ(threads("4:cpuset:/x\n"), 0U);
}

TEST_F(Quotas, TakeAnyText) {
  for (const char* text : {"", ":", "::", "0::", "0::a", "x\ny:z", "0::/../..\n1:cpu:"})
    EXPECT_EQ(threads(text), 0U) << text;
  file("cpu.max", "0 0\n");
  EXPECT_EQ(threads("0::/\n"), 0U);
  file("cpu.max", "1e300 1\n");
  EXPECT_EQ(threads("0::/\n"), 0U);
  file("cpu.max", "x\n");
  EXPECT_EQ(threads("0::/\n"), 0U);
}

TEST(Threads, AreNoMoreThanTheirLimit) {
  const unsigned all = hardware_threads();
  limit_threads(1);
  EXPECT_EQ(hardware_threads(), 1U);
  limit_threads(all + 1);
  EXPECT_EQ(hardware_threads(), all);
  limit_threads(0);
  EXPECT_EQ(hardware_threads(), all);
}

}  // namespace
}  // namespace boule
