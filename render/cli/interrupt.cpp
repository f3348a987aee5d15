#include "render/cli/interrupt.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstring>

namespace boule::cli {
namespace {

std::atomic<int> pending_signal{0};
std::atomic<bool> writing{false};
std::atomic<bool> removing{false};
std::atomic<bool> catching{false};
std::atomic<int> caught_signal{0};
std::atomic<bool> stop{false};
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

/// Async-signal-safe.
void print_end(int signal) {
  char text[96] = "boule: interrupted (";
  std::strcat(text, name_of(signal));
  std::strcat(text, "), ");
  std::strcat(text, end_of_line);
  std::strcat(text, "\n");
  print_at_once(text);
}

/// Async-signal-safe.
[[noreturn]] void leave(int signal) {
  remove_temporary();
  print_end(signal);
  ::_exit(128 + signal);
}

void handle(int signal) {
  int none = 0;
  if (catching && caught_signal.compare_exchange_strong(none, signal)) {
    stop = true;
  } else if (writing) {
    pending_signal = signal;
  } else {
    leave(signal);
  }
}

void handle_alarm(int) { stop = true; }

/// SIGALRM after so many seconds, 0: never.
void set_alarm(double seconds) {
  constexpr double longest = 1e9;  // what every time_t holds
  const double whole = std::floor(std::min(seconds, longest));
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  const double rest = std::min(seconds, longest) - whole;
  timer.it_value.tv_usec = static_cast<suseconds_t>(rest * 1e6);
  if (seconds > 0 && whole == 0)
    timer.it_value.tv_usec = std::max<suseconds_t>(timer.it_value.tv_usec, 1);
  setitimer(ITIMER_REAL, &timer, nullptr);
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

StopGuard::StopGuard(std::optional<double> time_limit, OnSignal on_signal) {
  stop = false;
  caught_signal = 0;
  catching = on_signal == OnSignal::stop;
  if (!time_limit) return;
  struct sigaction action {};
  action.sa_handler = handle_alarm;
  action.sa_flags = SA_RESTART;
  sigaction(SIGALRM, &action, nullptr);
  set_alarm(*time_limit);
}
StopGuard::~StopGuard() {
  set_alarm(0);
  catching = false;
}
const std::atomic<bool>& StopGuard::flag() { return stop; }
int StopGuard::caught() { return caught_signal; }
const char* StopGuard::caught_name() { return name_of(caught_signal); }

void leave_as_caught() { leave(caught_signal); }

void remove_temporary() {
  if (removing) ::unlink(temporary);
}

void print_at_once(const char* line) {
  char text[128] = "";
  if (line_open) std::strcat(text, "\n");
  std::strcat(text, line);
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
}

void set_written(const char* end) { end_of_line = end; }
void set_line_open(bool open) { line_open = open; }

void exit_if_interrupted() {
  if (pending_signal != 0) leave(pending_signal);
}

}  // namespace boule::cli
