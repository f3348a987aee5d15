#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>

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

/// What is done while a call runs.
struct WaitOptions {
  /// Called with the GIL ten times a second or so; what it throws ends the call. May be empty.
  std::function<void()> tick{};
  /// True once the call is to be stopped, without an exception. Called without the GIL; may be
  /// empty.
  std::function<bool()> is_out_of_time{};
  /// After a signal, wait for the work to stop however long it takes; a second signal leaves it.
  bool waits_for_end = false;
};

/// How a call ended.
enum class CallEnd { done, stopped_by_time, interrupted, left };

/// Runs `work` and waits for it. Needs the GIL, which it releases. If a signal or the tick raised
/// an exception of Python, that one is put into `raised` and the call is asked to stop. `left`: it
/// did not stop at once, and what it shares must not be touched. Exceptions of the work are thrown
/// unless a signal came.
CallEnd run_call(const std::shared_ptr<Call>& call, std::function<void()> work,
                 const WaitOptions& options, std::optional<pybind11::error_already_set>& raised);

/// The same for work that gives a value; a signal is thrown. The work and what it captures must not
/// hold references to Python's objects, except by keep().
template <class Work>
auto interruptible(const Work& work) {
  using Value = std::invoke_result_t<Work, Call&>;
  const auto call = std::make_shared<Call>();
  const auto value = std::make_shared<std::optional<Value>>();
  std::optional<pybind11::error_already_set> raised;
  run_call(
      call, [call, value, work] { value->emplace(work(*call)); }, {}, raised);
  if (raised) throw pybind11::error_already_set(*raised);
  return std::move(**value);
}

/// A reference that may be dropped by any thread, with or without the GIL.
std::shared_ptr<const pybind11::object> keep(pybind11::object object);

/// Waits for calls that were left, at the end of the process; a few seconds at most.
void wait_for_left_calls();

}  // namespace boule::python
