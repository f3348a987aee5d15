#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>

#include "render/apps/python/values/interrupts.h"
#include "render/frame/scheduler.h"

namespace boule::python {

/// One long call of the library. It runs on a thread of its own, while the thread that Python
/// called waits without the GIL and looks for signals: Ctrl-C is answered within 0.1 s, whatever
/// the library is at. A call that does not stop when it is told to is left to itself, so its work
/// owns all that it uses.
class Call {
 public:
  /// True asks the work to stop.
  std::atomic<bool> cancel{false};

  /// Runs the loops of the work. They end by an exception once it is asked to stop.
  [[nodiscard]] ParallelFor parallel_for() { return scheduler_.parallel_for(&cancel); }

 private:
  friend class Waiting;

  Scheduler scheduler_{0};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_done_ = false;
  std::exception_ptr error_;
};

/// What stops a call, besides signals.
struct WaitOptions {
  /// True once the call is to be stopped, without an exception. May be empty.
  std::function<bool()> is_out_of_time{};
  /// After a signal, wait for the work to stop however long it takes; a second signal leaves it.
  bool waits_for_end = false;
};

/// How a call ended. `left`: it did not stop at once, and what it shares must not be touched.
enum class CallEnd { done, stopped_by_time, interrupted, left };

/// Runs work and waits for it. All of it needs the GIL, which it releases while it waits.
class Waiting {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts the work.
  Waiting(std::shared_ptr<Call> call, std::function<void()> work, WaitOptions options = {});
  /// Asks the work to stop if it still runs.
  ~Waiting() { call_->cancel = true; }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

  /// Waits until the call has ended, by itself or by a signal; false if `until` comes first.
  bool wait(Clock::time_point until = Clock::time_point::max());
  /// Ends the call as a signal does.
  void stop();
  /// How it ended. Throws what the work has thrown, if that ended it. Precondition: wait() was true
  /// or stop() was called.
  [[nodiscard]] CallEnd end() const;
  /// The exception of Python that a signal has raised, if one did.
  [[nodiscard]] const std::optional<pybind11::error_already_set>& raised() const { return raised_; }

 private:
  bool sleep(std::chrono::milliseconds time);
  bool has_raised();

  std::shared_ptr<Call> call_;
  WaitOptions options_;
  Interrupts interrupts_;
  std::optional<pybind11::error_already_set> raised_;
  std::optional<CallEnd> end_;
  bool is_out_of_time_ = false;
};

/// Runs work that gives a value; a signal is thrown. The work and what it captures must not hold
/// references to Python's objects, except by keep().
template <class Work>
auto interruptible(const Work& work) {
  using Value = std::invoke_result_t<Work, Call&>;
  const auto call = std::make_shared<Call>();
  const auto value = std::make_shared<std::optional<Value>>();
  Waiting waiting(call, [call, value, work] { value->emplace(work(*call)); });
  waiting.wait();
  if (waiting.end() != CallEnd::done) throw pybind11::error_already_set(*waiting.raised());
  return std::move(**value);
}

/// A reference that may be dropped by any thread, with or without the GIL.
std::shared_ptr<const pybind11::object> keep(pybind11::object object);

/// Sees to it that calls end before the interpreter does, and are right in forked processes.
void bind_ends_of_calls(pybind11::module_& module);

}  // namespace boule::python
