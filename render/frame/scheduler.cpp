#include "render/frame/scheduler.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <new>
#include <stdexcept>

#include "core/base/exact_math.h"
#include "core/base/float_environment.h"
#include "render/threads/threads.h"

namespace boule {
namespace {

/// One loop, which its workers share.
class Loop {
 public:
  Loop(std::size_t count, const Scheduler::Body& body, const std::atomic<bool>* cancel)
      : count_(count), body_(body), cancel_(cancel) {}

  /// Works until nothing is left. Never throws.
  void work(unsigned worker) {
    const FloatEnvironment environment;
    try {
      while (!stopped()) {
        const std::size_t index = next_.fetch_add(1, std::memory_order_relaxed);
        if (index >= count_) return;
        body_(worker, index);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      failed_.store(true, std::memory_order_relaxed);
    }
  }

  /// The first exception, or null. Precondition: all workers have finished.
  [[nodiscard]] std::exception_ptr error() const { return error_; }

 private:
  [[nodiscard]] bool stopped() const {
    return failed_.load(std::memory_order_relaxed) ||
           (cancel_ != nullptr && cancel_->load(std::memory_order_relaxed));
  }

  const std::size_t count_;
  const Scheduler::Body& body_;
  const std::atomic<bool>* const cancel_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
};

Diagnostic describe(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory");
  } catch (const std::exception& exception) {
    return Diagnostic::of(exception.what());
  } catch (...) {
    return Diagnostic::of("unknown failure");
  }
}

}  // namespace

Scheduler::Scheduler(unsigned threads) {
  workers_ = std::min(threads == 0 ? hardware_threads() : threads, max_workers);
}

std::exception_ptr Scheduler::run_all(std::size_t count, const Body& body,
                                      const std::atomic<bool>* cancel) {
  Loop loop(count, body, cancel);
  const std::size_t wanted = std::min<std::size_t>(workers_, count);
  {
    const auto work = [&loop](std::size_t index) { loop.work(static_cast<unsigned>(index + 1)); };
    const Threads others(wanted > 1 ? wanted - 1 : 0, work);
    loop.work(0);
    threads_used_ = static_cast<unsigned>(others.size() + 1);
  }
  return loop.error();
}

Status Scheduler::run(std::size_t count, const Body& body, const std::atomic<bool>* cancel) {
  if (const std::exception_ptr error = run_all(count, body, cancel)) return describe(error);
  return {};
}

ParallelFor Scheduler::parallel_for(const std::atomic<bool>* cancel) {
  return [this, cancel](std::size_t count, const std::function<void(std::size_t)>& body) {
    const auto indexed = [&body](unsigned, std::size_t index) { body(index); };
    if (const auto error = run_all(count, indexed, cancel)) std::rethrow_exception(error);
    if (cancel != nullptr && *cancel) throw std::runtime_error("it was cancelled");
  };
}

Status diagnose(const std::function<void()>& call) {
  try {
    call();
  } catch (...) {
    return describe(std::current_exception());
  }
  return {};
}

}  // namespace boule
