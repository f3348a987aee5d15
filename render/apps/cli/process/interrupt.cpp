#include "render/apps/cli/process/interrupt.h"

#include <unistd.h>

#include <climits>
#include <csignal>
#include <cstring>

#include "render/apps/cli/process/standard_error.h"

namespace boule::cli {
namespace {

std::atomic<int> pending_signal{0};
std::atomic<bool> writing_file{false};
std::atomic<bool> removing{false};
std::atomic<bool> catching{false};
std::atomic<int> caught_signal{0};
std::atomic<bool> stop_flag{false};
std::atomic<const char*> end_of_line{"nothing written"};
std::atomic<bool> leaving{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

/// The file to remove while `removing`. No file's name can be longer.
char temporary[PATH_MAX] = "";

const char* signal_name(int signal) {
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
[[noreturn]] void leave(int signal) {
  char text[96] = "boule: interrupted (";
  std::strcat(text, signal_name(signal));
  std::strcat(text, "), ");
  std::strcat(text, end_of_line);
  std::strcat(text, "\n");
  leave_at_once(text, 128 + signal);
}

void handle(int signal) {
  int none = 0;
  if (catching && caught_signal.compare_exchange_strong(none, signal)) {
    stop_flag = true;
  } else if (writing_file) {
    pending_signal = signal;
  } else {
    leave(signal);
  }
}

}  // namespace

void install_interrupt_handlers() {
  // A closed pipe or a size limit does not end the program before it has removed what is
  // unfinished.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = handle;
  sigfillset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    sigaction(signal, nullptr, &old);
    // A signal that nohup or a background shell ignores stays ignored.
    if (old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

void ignore_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
}

WriteGuard::WriteGuard() { writing_file = true; }
WriteGuard::~WriteGuard() { writing_file = false; }
bool WriteGuard::interrupted() { return pending_signal != 0; }

RemovalGuard::RemovalGuard(const std::string& path) {
  temporary[path.copy(temporary, sizeof temporary - 1)] = '\0';
  removing = true;
  writing_file = false;
  exit_if_interrupted();
}
RemovalGuard::~RemovalGuard() {
  writing_file = true;
  removing = false;
}

StopGuard::StopGuard(OnSignal on_signal) {
  stop_flag = false;
  caught_signal = 0;
  catching = on_signal == OnSignal::stop;
}
StopGuard::~StopGuard() { catching = false; }
const std::atomic<bool>& StopGuard::flag() { return stop_flag; }
void StopGuard::stop() { stop_flag = true; }
int StopGuard::caught() { return caught_signal; }
const char* StopGuard::caught_name() { return signal_name(caught_signal); }

void leave_as_caught() { leave(caught_signal); }

void leave_unread() { leave_at_once("", 128 + SIGPIPE); }

void leave_at_once(const char* line, int code) {
  sigset_t all{};
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);  // a handler on this thread would wait for itself
  while (leaving.exchange(true)) ::pause();
  if (removing) ::unlink(temporary);
  write_last_line(line);
  ::_exit(code);
}

void set_written(const char* end) { end_of_line = end; }

void exit_if_interrupted() {
  if (pending_signal != 0) leave(pending_signal);
}

}  // namespace boule::cli
