#include "render/cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>

namespace boule::cli {
namespace {

std::atomic<int> pending_signal{0};
std::atomic<bool> writing{false};
std::atomic<bool> removing{false};
std::atomic<const char*> end_of_line{"nothing written"};
std::atomic<bool> line_open{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

/// What to remove while `removing`. No file can be made whose name is longer.
char temporary[PATH_MAX] = "";

const char* name_of(int signal) {
  switch (signal) {
    case SIGINT:
      return "SIGINT";
    case SIGHUP:
      return "SIGHUP";
    default:
      return "SIGTERM";
  }
}

/// Async-signal-safe: one line, in one write.
void print_end(int signal) {
  char text[96] = "";
  if (line_open) std::strcat(text, "\n");
  std::strcat(text, "boule: interrupted (");
  std::strcat(text, name_of(signal));
  std::strcat(text, "), ");
  std::strcat(text, end_of_line);
  std::strcat(text, "\n");
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
}

/// Async-signal-safe.
[[noreturn]] void leave(int signal) {
  if (removing) ::unlink(temporary);
  print_end(signal);
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

RemovalGuard::RemovalGuard(const std::string& path) {
  temporary[path.copy(temporary, sizeof temporary - 1)] = '\0';
  removing = true;
  writing = false;
  exit_if_interrupted();
}
RemovalGuard::~RemovalGuard() {
  writing = true;
  removing = false;
}

void set_written(const char* end) { end_of_line = end; }
void set_line_open(bool open) { line_open = open; }

void exit_if_interrupted() {
  if (pending_signal != 0) leave(pending_signal);
}

}  // namespace boule::cli
