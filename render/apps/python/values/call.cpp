#include "render/apps/python/values/call.h"

#include <unistd.h>
#include <cstdio>
#include <cstdlib>

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

#include "render/apps/python/values/presence.h"
#include "render/threads/threads.h"

namespace py = pybind11;

namespace boule::python {
namespace {

using std::chrono::milliseconds;
using Clock = Waiting::Clock;

constexpr milliseconds look_every{20};  // for signals
constexpr milliseconds patience{60};    // with a call that is asked to stop

/// The calls whose work goes on, also those that were left.
struct Running {
  std::mutex mutex;
  std::vector<Call*> calls;

  void add(Call& call) {
    const std::lock_guard lock(mutex);
    calls.push_back(&call);
  }
  void remove(Call& call) {
    const std::lock_guard lock(mutex);
    calls.erase(std::find(calls.begin(), calls.end(), &call));
  }
  /// Asks all to stop; true if there are none.
  bool stop() {
    const std::lock_guard lock(mutex);
    for (Call* const call : calls) call->cancel = true;
    return calls.empty();
  }
};

/// Never destroyed: what was left may outlive all else.
Running* running = new Running;

void pause(milliseconds time) {
  const py::gil_scoped_release no_gil;
  std::mutex mutex;
  std::condition_variable never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, time);
}

}  // namespace

Waiting::Waiting(std::shared_ptr<Call> call, std::function<void()> work, WaitOptions options)
    : call_(std::move(call)), options_(std::move(options)) {
  const auto run = [call = call_, work = std::move(work)]() mutable noexcept {
    std::exception_ptr error;
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
    work = nullptr;  // what it owns ends before the waiting does
    {
      const std::lock_guard lock(call->mutex_);
      call->error_ = std::move(error);
      call->is_done_ = true;
      call->changed_.notify_all();
    }
    running->remove(*call);
  };
  const std::function<void()> here = run;
  running->add(*call_);
  try {
    if (start_detached(here)) return;
  } catch (const std::bad_alloc&) {  // then here
  }
  const py::gil_scoped_release no_gil;
  here();
}

/// So long at most, without the GIL; true if the work has ended.
bool Waiting::sleep(milliseconds time) {
  const py::gil_scoped_release no_gil;
  std::unique_lock lock(call_->mutex_);
  return call_->changed_.wait_for(lock, time, [&] { return call_->is_done_; });
}

/// Keeps what ends the call, if anything does.
bool Waiting::has_raised() {
  if (Presence::is_over()) {
    PyErr_SetNone(PyExc_SystemExit);
  } else if (interrupts_.take()) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  } else if (PyErr_CheckSignals() == 0) {
    return false;
  }
  raised_.emplace();
  return true;
}

bool Waiting::wait(Clock::time_point until) {
  while (!end_) {
    if (sleep(look_every)) {
      const bool was_asked = call_->cancel && has_raised();  // by the end of the interpreter
      end_ = was_asked ? CallEnd::interrupted : CallEnd::done;
      break;
    }
    is_out_of_time_ = options_.is_out_of_time && options_.is_out_of_time();
    if (is_out_of_time_ || has_raised()) {
      stop();
    } else if (Clock::now() >= until) {
      return false;
    }
  }
  return true;
}

void Waiting::stop() {
  if (end_) return;
  call_->cancel = true;
  const bool waits = options_.waits_for_end || is_out_of_time_;
  bool has_ended = sleep(patience);
  while (waits && !has_ended && !has_raised()) has_ended = sleep(look_every);
  const CallEnd ended = is_out_of_time_ ? CallEnd::stopped_by_time : CallEnd::interrupted;
  end_ = has_ended ? ended : CallEnd::left;
}

CallEnd Waiting::end() const {
  if (*end_ == CallEnd::done && call_->error_) std::rethrow_exception(call_->error_);
  return *end_;
}

std::shared_ptr<const py::object> keep(py::object object) {
  return {new py::object(std::move(object)), [](const py::object* kept) {
            if (!Presence::enter()) return;  // there is nobody to give it back to
            {
              const py::gil_scoped_acquire gil;
              delete kept;
            }
            Presence::leave();
          }};
}

namespace {

/// Ends the calls that other threads are inside of, and those that were left: these get a few
/// seconds, or until Ctrl-C.
void end_calls() {
  Presence::close();
  running->stop();
  while (Presence::count() > 1) pause(milliseconds{5});  // this call is one
  const auto end = Clock::now() + std::chrono::seconds(5);
  while (!running->stop() && Clock::now() < end) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    pause(look_every);
  }
}

/// Work that was left and does not end uses what the end of the process would destroy.
void end_without_destructors(int status, void* /*argument*/) {
  std::fflush(nullptr);
  _exit(status);
}

void look_for_left_calls() {
  if (!running->stop()) on_exit(end_without_destructors, nullptr);
}

/// In a forked process, which has none of the threads.
void forget_calls() {
  running = new Running;
  Presence::forget();
}

}  // namespace

void bind_ends_of_calls(py::module_& module) {
  module.def("end_calls", &end_calls, inside());
  module.def("forget_calls", &forget_calls);
  py::module_::import("atexit").attr("register")(module.attr("end_calls"));
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") =
                                                         module.attr("forget_calls"));
  Py_AtExit(look_for_left_calls);
}

}  // namespace boule::python
