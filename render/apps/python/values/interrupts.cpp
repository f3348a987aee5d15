#include "render/apps/python/values/interrupts.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <csignal>
#include <optional>

namespace py = pybind11;

namespace boule::python {
namespace {

std::atomic<int> arrived{0};
struct sigaction next {};  ///< what counts stands before this
int watching = 0;          ///< under the GIL
/// How many had come when a call of this thread began that none ended.
thread_local std::optional<int> got_over;

void count_and_pass_on(int number, siginfo_t* info, void* context) {
  ++arrived;
  if ((next.sa_flags & SA_SIGINFO) != 0) {
    next.sa_sigaction(number, info, context);
  } else {
    next.sa_handler(number);
  }
}

bool is_ours(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) != 0 && action.sa_sigaction == count_and_pass_on;
}

/// Where a SIGINT reaches Python. Whoever sets another handler meanwhile takes ours away.
void count_interrupts() {
  struct sigaction now {};
  sigaction(SIGINT, nullptr, &now);
  const bool has_handler = now.sa_handler != SIG_DFL && now.sa_handler != SIG_IGN;
  if (is_ours(now) || !has_handler) return;
  next = now;
  now.sa_flags |= SA_SIGINFO;
  now.sa_sigaction = count_and_pass_on;
  sigaction(SIGINT, &now, nullptr);
}

void stop_counting() {
  struct sigaction now {};
  sigaction(SIGINT, nullptr, &now);
  if (is_ours(now)) sigaction(SIGINT, &next, nullptr);
}

py::object ask(const char* question) {
  return py::module_::import("boule._interrupts").attr(question)();
}

/// The KeyboardInterrupt that the main thread handles, or null. Only to be compared.
const void* handled_by_main() {
  const py::object handled = ask("handled");
  return handled.is_none() ? nullptr : handled.ptr();
}

}  // namespace

Interrupts::Interrupts() : is_main_(py::cast<bool>(ask("is_main"))) {
  if (is_main_) return;
  ++watching;
  count_interrupts();
  known_ = at_begin_ = arrived;
  handled_ = handled_by_main();
  if (!got_over) got_over = known_;
  is_late_ = *got_over != known_;
}

Interrupts::~Interrupts() {
  if (is_main_) return;
  if (!has_taken_) got_over = at_begin_;
  if (--watching == 0) stop_counting();
}

bool Interrupts::take() {
  if (is_main_) return false;
  const int before = known_;
  known_ = arrived;
  bool has_come = known_ != before && py::cast<bool>(ask("raises"));
  if (!has_taken_ && !has_come) {
    const void* const handled = handled_by_main();
    const bool is_new = handled != nullptr && handled != handled_;
    has_come =
        is_new || (is_late_ && (handled != nullptr || py::cast<bool>(ask("has_ended_main"))));
  }
  has_taken_ = has_taken_ || has_come;
  return has_come;
}

}  // namespace boule::python
