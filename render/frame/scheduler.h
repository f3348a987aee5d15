#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace boule {

/// Runs loops on several threads, the caller's among them: each worker takes the next index until
/// none is left. A thread that cannot be had means fewer threads. Every worker computes in a
/// FloatEnvironment.
class Scheduler {
 public:
  /// body(worker, index), worker < workers(); one worker does one index at a time. Worker 0 is the
  /// caller's thread.
  using Body = std::function<void(unsigned worker, std::size_t index)>;

  /// 0 threads: as many as the hardware runs at once. Never more than max_workers.
  explicit Scheduler(unsigned threads);

  static constexpr unsigned max_workers = 1024;

  /// The number of threads that are tried for.
  [[nodiscard]] unsigned workers() const { return workers_; }
  /// The number of threads that the last loop had.
  [[nodiscard]] unsigned threads_used() const { return threads_used_; }

  /// Calls body for 0 .. count - 1, each index at most once. An exception in a worker stops the
  /// others and becomes the Diagnostic, an empty body is such a one; `*cancel` true stops them
  /// without. Throws nothing else.
  Status run(std::size_t count, const Body& body, const std::atomic<bool>* cancel = nullptr);

  /// This scheduler as a ParallelFor; valid as long as it. Exceptions reach the caller.
  ParallelFor parallel_for();

 private:
  std::exception_ptr run_all(std::size_t count, const Body& body, const std::atomic<bool>* cancel);

  unsigned workers_;
  unsigned threads_used_ = 0;
};

/// Calls it: nothing, or the Diagnostic that its exception, of any type, becomes.
Status diagnose(const std::function<void()>& call);

}  // namespace boule
