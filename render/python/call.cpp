#include "render/python/call.h"

#include <chrono>
#include <utility>

#include "render/threads/threads.h"

namespace py = pybind11;

namespace boule::python {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds look_every{20};  // for signals
constexpr milliseconds tick_every{100};
constexpr milliseconds patience{60};  // with a call that is asked to stop

std::atomic<int> running{0};

}  // namespace

/// The waiting side of a call.
class Waiting {
 public:
  explicit Waiting(std::shared_ptr<Call> call) : call_(std::move(call)) {}

  void start(std::function<void()> work);
  /// Waits so long at most; true if the work has ended. Without the GIL.
  bool wait(milliseconds time);
  CallEnd finish(const WaitOptions& options, std::optional<py::error_already_set>& raised);
  /// Throws what the work has thrown.
  void rethrow() const {
    if (call_->error_) std::rethrow_exception(call_->error_);
  }

 private:
  bool watch(const WaitOptions& options, std::optional<py::error_already_set>& raised);
  bool wait_for_end(std::optional<py::error_already_set>& raised);

  std::shared_ptr<Call> call_;
  bool is_out_of_time_ = false;
};

void Waiting::start(std::function<void()> work) {
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
    --running;
  };
  ++running;
  if (start_detached(run)) return;
  const std::function<void()> here = run;
  here();
}

bool Waiting::wait(milliseconds time) {
  std::unique_lock lock(call_->mutex_);
  return call_->changed_.wait_for(lock, time, [&] { return call_->is_done_; });
}

/// Keeps what Python has raised; true if it has.
bool has_raised(std::optional<py::error_already_set>& raised) {
  if (PyErr_CheckSignals() == 0) return false;
  raised.emplace();
  return true;
}

/// Waits until the work ends or is to be stopped; true if it has ended. Holds the GIL now and then.
bool Waiting::watch(const WaitOptions& options, std::optional<py::error_already_set>& raised) {
  auto ticked = Clock::now();
  while (!wait(look_every)) {
    const auto now = Clock::now();
    if (options.is_out_of_time && options.is_out_of_time()) {
      is_out_of_time_ = true;
      return false;
    }
    const py::gil_scoped_acquire gil;
    if (has_raised(raised)) return false;
    if (!options.tick || now - ticked < tick_every) continue;
    ticked = now;
    try {
      options.tick();
    } catch (py::error_already_set& error) {
      raised.emplace(error);
      return false;
    }
  }
  return true;
}

/// Waits for work that was asked to stop; false if a signal comes first.
bool Waiting::wait_for_end(std::optional<py::error_already_set>& raised) {
  while (!wait(look_every)) {
    const py::gil_scoped_acquire gil;
    if (has_raised(raised)) return false;
  }
  return true;
}

CallEnd Waiting::finish(const WaitOptions& options, std::optional<py::error_already_set>& raised) {
  if (watch(options, raised)) return CallEnd::done;
  call_->cancel = true;
  const bool waits = options.waits_for_end || is_out_of_time_;
  const bool has_ended = waits ? wait_for_end(raised) : wait(patience);
  if (!has_ended) return CallEnd::left;
  return is_out_of_time_ ? CallEnd::stopped_by_time : CallEnd::interrupted;
}

CallEnd run_call(const std::shared_ptr<Call>& call, std::function<void()> work,
                 const WaitOptions& options, std::optional<py::error_already_set>& raised) {
  CallEnd end = CallEnd::done;
  {
    const py::gil_scoped_release no_gil;
    Waiting waiting(call);
    waiting.start(std::move(work));
    end = waiting.finish(options, raised);
  }
  if (end == CallEnd::done) Waiting(call).rethrow();
  return end;
}

std::shared_ptr<const py::object> keep(py::object object) {
  return {new py::object(std::move(object)), [](const py::object* kept) {
            if (_Py_IsFinalizing() != 0) return;  // there is nobody to give it back to
            const py::gil_scoped_acquire gil;
            delete kept;
          }};
}

void wait_for_left_calls() {
  const py::gil_scoped_release no_gil;
  std::mutex mutex;
  std::condition_variable never;
  std::unique_lock lock(mutex);
  const auto end = Clock::now() + std::chrono::seconds(5);
  while (running != 0 && Clock::now() < end) never.wait_for(lock, look_every);
}

}  // namespace boule::python
