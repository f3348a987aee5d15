#pragma once

#include <atomic>
#include <string>

namespace boule::cli {

/// Makes SIGINT, SIGTERM and SIGHUP end the program at once with "boule: interrupted (SIGTERM),
/// nothing written" and exit status 128 + n: right from the signal's handler, except while a
/// WriteGuard lives. Where the output had been written already the line says that instead.
void install_interrupt_handlers();

/// While a temporary file may exist a signal only raises a flag, so that the file is removed.
class WriteGuard {
 public:
  WriteGuard();
  ~WriteGuard();
  WriteGuard(const WriteGuard&) = delete;
  WriteGuard& operator=(const WriteGuard&) = delete;

  /// True after a signal.
  static bool interrupted();
};

/// Within a WriteGuard: while it lives, a signal ends the program at once all the same, after
/// removing this temporary file. For work that takes longer than a signal may wait.
class RemovalGuard {
 public:
  /// Ends the program if a signal has come already.
  explicit RemovalGuard(const std::string& path);
  ~RemovalGuard();
  RemovalGuard(const RemovalGuard&) = delete;
  RemovalGuard& operator=(const RemovalGuard&) = delete;
};

/// Whether a signal ends the program, or only what it does.
enum class OnSignal { leave, stop };

/// While it lives there is a flag that rendering watches. With OnSignal::stop the first signal
/// raises it, so that what there is can still be written: the next one is treated as if there were
/// no StopGuard. One at a time.
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

/// Says that the output is in place: from now on "nothing written" would be wrong. `end` is what
/// the line says instead, a literal such as "the picture had been written".
void set_written(const char* end);

/// Ends the program at once, on any thread: removes the temporary file of a RemovalGuard, writes
/// the line to standard error, and leaves with that code. The first of those who call it wins. What
/// a signal's handler may do; needs no memory.
[[noreturn]] void leave_at_once(const char* line, int code);

/// Ends the program as the handler would have, if a signal came while a WriteGuard lived.
void exit_if_interrupted();

}  // namespace boule::cli
