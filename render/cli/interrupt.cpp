#include "render/cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <cstring>

namespace boule::cli {
namespace {

std::atomic<int> pending_signal{0};
std::atomic<bool> writing{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

const char* message_of(int signal) {
  switch (signal) {
    case SIGINT:
      return "boule: interrupted (SIGINT), nothing written\n";
    case SIGHUP:
      return "boule: interrupted (SIGHUP), nothing written\n";
    default:
      return "boule: interrupted (SIGTERM), nothing written\n";
  }
}

/// Async-signal-safe.
[[noreturn]] void leave(int signal) {
  const char* const message = message_of(signal);
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, std::strlen(message));
  ::_exit(128 + signal);
}

void handle(int signal) {
  if (writing) {
    pending_signal = signal;
  } else {
    leave(signal);
  }
}

}  // namespace

void install_interrupt_handlers() {
  // A closed pipe or a size limit is an error to report, not a reason to die in silence.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = handle;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    sigaction(signal, nullptr, &old);
    // nohup and background shells ignore a signal on purpose: so do we.
    if (old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

WriteGuard::WriteGuard() { writing = true; }
WriteGuard::~WriteGuard() { writing = false; }
bool WriteGuard::interrupted() { return pending_signal != 0; }

void exit_if_interrupted() {
  if (pending_signal != 0) leave(pending_signal);
}

}  // namespace boule::cli
