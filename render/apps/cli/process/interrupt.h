#pragma once

#include <atomic>
#include <string>

namespace boule::cli {

/// Makes SIGINT, SIGTERM and SIGHUP end the program at once with "boule: interrupted (SIGTERM),
/// nothing written" and exit status 128 + n. The signal's handler does so itself, except while a
/// WriteGuard lives. If the output has been written already, the line says that instead.
void install_interrupt_handlers();

/// From now on those signals do nothing: the work is over, and only other processes are waited for.
void ignore_interrupts();

/// While it lives, a signal only raises a flag, so that a temporary file can be removed.
class WriteGuard {
 public:
  WriteGuard();
  ~WriteGuard();
  WriteGuard(const WriteGuard&) = delete;
  WriteGuard& operator=(const WriteGuard&) = delete;

  /// True after a signal.
  static bool interrupted();
};

/// For work within a WriteGuard that takes longer than a signal may wait: while it lives, a signal
/// removes this temporary file and then ends the program at once all the same.
class RemovalGuard {
 public:
  /// Ends the program if a signal has come already.
  explicit RemovalGuard(const std::string& path);
  ~RemovalGuard();
  RemovalGuard(const RemovalGuard&) = delete;
  RemovalGuard& operator=(const RemovalGuard&) = delete;
};

/// Whether a signal ends the program, or only the rendering.
enum class OnSignal { leave, stop };

/// Owns the flag that rendering watches. With OnSignal::stop the first signal raises it, so that
/// the unfinished picture can still be written; the next signal is treated as if there were no
/// StopGuard. One at a time.
class StopGuard {
 public:
  /// Lowers the flag.
  explicit StopGuard(OnSignal on_signal);
  ~StopGuard();
  StopGuard(const StopGuard&) = delete;
  StopGuard& operator=(const StopGuard&) = delete;

  static const std::atomic<bool>& flag();
  /// Raises it, on any thread: a time limit has ended.
  static void stop();

  /// The signal that was caught since then, or 0.
  static int caught();
  /// "SIGINT", if that was it.
  static const char* caught_name();
};

/// Ends the program as the handler would have at the signal that a StopGuard caught.
[[noreturn]] void leave_as_caught();

/// To be called when the output is in place: from then on "nothing written" would be wrong. `end`,
/// a literal such as "the picture had been written", takes its place in the line.
void set_written(const char* end);

/// Ends the program in silence with the exit status of SIGPIPE, 141: nobody reads its output any
/// more. What was written to files stays.
[[noreturn]] void leave_unread();

/// Ends the program at once, on any thread: removes the temporary file of a RemovalGuard, writes
/// the line to standard error, and leaves with that code. If several threads call it, the first one
/// wins. It is async-signal-safe and needs no memory.
[[noreturn]] void leave_at_once(const char* line, int code);

/// Ends the program as the handler would have, if a signal came while a WriteGuard lived.
void exit_if_interrupted();

/// What `write` returns, a Status or a Result, which is called within a WriteGuard. If that is no
/// error, and `end` is not null, set_written(end) is called. Ends the program if a signal came.
template <class Write>
auto write_guarded(const Write& write, const char* end = nullptr) {
  auto done = [&] {
    const WriteGuard guard;
    auto status = write();
    if (status && end != nullptr) set_written(end);
    return status;
  }();
  exit_if_interrupted();
  return done;
}

}  // namespace boule::cli
