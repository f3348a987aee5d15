#include "render/cli/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>

namespace boule::cli {
namespace {

std::atomic<int> pending_signal{0};
std::atomic<bool> writing{false};
std::atomic<bool> picture_written{false};
std::atomic<bool> line_open{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

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
  std::strcat(text, picture_written ? "), the picture had been written\n" : "), nothing written\n");
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
}

/// Async-signal-safe.
[[noreturn]] void leave(int signal) {
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

void set_picture_written() { picture_written = true; }
void set_line_open(bool open) { line_open = open; }

void exit_if_interrupted() {
  if (pending_signal != 0) leave(pending_signal);
}

}  // namespace boule::cli
