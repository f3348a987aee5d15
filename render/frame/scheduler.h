#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace boule {

/// Runs loops on several threads, the caller's included: each worker takes the next index until all
/// are done. Every worker computes in a FloatEnvironment.
class Scheduler {
 public:
  /// body(worker, index) with worker < workers(). A worker calls it for one index at a time. Worker
  /// 0 is the caller's thread.
  using Body = std::function<void(unsigned worker, std::size_t index)>;

  /// For `threads` threads, at most max_workers; 0 means as many as the hardware runs at once.
  explicit Scheduler(unsigned threads);

  static constexpr unsigned max_workers = 1024;

  /// The number of threads that a loop asks for.
  [[nodiscard]] unsigned workers() const { return workers_; }
  /// The number of threads that the last loop had.
  [[nodiscard]] unsigned threads_used() const { return threads_used_; }

  /// Calls body for 0 .. count - 1, each index at most once. An exception in a worker stops the
  /// others and becomes the Diagnostic; calling an empty body is such an exception. If `*cancel`
  /// becomes true, the loop stops without a Diagnostic.
  Status run(std::size_t count, const Body& body, const std::atomic<bool>* cancel = nullptr);

  /// This scheduler as a ParallelFor, which is valid as long as the scheduler. Exceptions propagate
  /// to the caller. If `*cancel` becomes true, a loop stops and throws std::runtime_error.
  ParallelFor parallel_for(const std::atomic<bool>* cancel = nullptr);

 private:
  std::exception_ptr run_all(std::size_t count, const Body& body, const std::atomic<bool>* cancel);

  unsigned workers_;
  unsigned threads_used_ = 0;
};

/// Calls `call`, and turns an exception of any type into a Diagnostic.
Status diagnose(const std::function<void()>& call);

}  // namespace boule
