#include "render/frame/scheduler.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "render/frame/float_environment.h"

namespace boule {
namespace {

/// One loop, shared by its workers.
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

  /// The first exception, or null. Once all have worked.
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
    return {"out of memory", {}, {}, 0, 0};
  } catch (const std::exception& exception) {
    return {exception.what(), {}, {}, 0, 0};
  } catch (...) {
    return {"unknown failure in a worker", {}, {}, 0, 0};
  }
}

/// So many threads, or as many as can be had; each calls body(0), body(1), .. in its turn.
template <class Body>
std::vector<std::thread> start_threads(std::size_t count, const Body& body) {
  std::vector<std::thread> threads;
  try {
    threads.reserve(count);
    while (threads.size() < count)
      threads.emplace_back([body, index = threads.size()] { body(index); });
  } catch (const std::system_error&) {  // those that started do the work
  } catch (const std::bad_alloc&) {
  }
  return threads;
}

}  // namespace

Scheduler::Scheduler(unsigned threads) {
  if (threads == 0) threads = std::thread::hardware_concurrency();
  workers_ = std::clamp(threads, 1u, max_workers);
}

std::exception_ptr Scheduler::run_all(std::size_t count, const Body& body,
                                      const std::atomic<bool>* cancel) {
  Loop loop(count, body, cancel);
  const std::size_t wanted = std::min<std::size_t>(workers_, count);
  auto others = start_threads(wanted > 1 ? wanted - 1 : 0, [&loop](std::size_t index) {
    loop.work(static_cast<unsigned>(index + 1));
  });
  loop.work(0);
  for (std::thread& thread : others) thread.join();
  threads_used_ = static_cast<unsigned>(others.size() + 1);
  return loop.error();
}

Status Scheduler::run(std::size_t count, const Body& body, const std::atomic<bool>* cancel) {
  if (const std::exception_ptr error = run_all(count, body, cancel)) return describe(error);
  return std::nullopt;
}

ParallelFor Scheduler::parallel_for() {
  return [this](std::size_t count, const std::function<void(std::size_t)>& body) {
    const auto indexed = [&body](unsigned, std::size_t index) { body(index); };
    if (const auto error = run_all(count, indexed, nullptr)) std::rethrow_exception(error);
  };
}

bool can_start_threads(unsigned count) {
  std::atomic<bool> counted{false};
  auto threads = start_threads(count, [&counted](std::size_t) { counted.wait(false); });
  counted = true;
  counted.notify_all();
  for (std::thread& thread : threads) thread.join();
  return threads.size() == count;
}

}  // namespace boule
