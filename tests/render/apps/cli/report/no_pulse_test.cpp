// Where no thread is to be had for it, time goes on all the same. (The thread sanitizer has a
// pthread_create of its own.)
#if !defined(__SANITIZE_THREAD__)
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/report/live_report.h"

namespace {
std::atomic<bool> no_threads{false};
}

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*run)(void*), void* argument) {
  static const auto create =
      reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  return no_threads ? EAGAIN : create(thread, attributes, run, argument);
}

namespace boule::cli {
namespace {

/// It looks at the clock when a block has ended.
TEST(NoPulse, TheWorkItselfEndsATimeLimit) {
  RenderCommand command;
  command.verbosity = Verbosity::quiet;
  const StopGuard guard(OnSignal::leave);
  LiveReport live(command);
  no_threads = true;
  live.start_time_limit(1e-9);
  no_threads = false;
  live.start_pass("pixels");
  EXPECT_FALSE(StopGuard::flag());
  live.update({0.5, 1});
  EXPECT_TRUE(StopGuard::flag());
}

}  // namespace
}  // namespace boule::cli
#endif
