#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace boule::test {

/// The built program while it runs on a terminal of its own (a pty), which is its standard input,
/// output and error. Killed at the end if it still runs.
class RunningProgram {
 public:
  /// A terminal of so many columns.
  explicit RunningProgram(const std::vector<std::string>& arguments, unsigned short columns = 100);
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();

  /// Reads until `text` has been shown on the terminal, after what was waited for before; false if
  /// the program ends first.
  bool wait_for(const std::string& text);

  /// Reads until the program has a file of so many bytes open in `folder` that has no name (yet);
  /// false if it ends before.
  bool wait_for_output(const std::string& folder, std::intmax_t bytes);

  /// Reads until the program has had the processor for so many seconds from now on, in all its
  /// threads; false if it ends before.
  bool wait_for_work(double seconds);

  /// Reads until all of its threads wait for something, again and again; false if it ends before.
  bool wait_for_sleep();

  void send(int signal) const;

  /// Reads to the end: the exit code, and all that was shown as `out`, each line ended by "\r\n".
  ProgramRun finish();

 private:
  bool read_some(int timeout_ms);
  [[nodiscard]] bool has_output(const std::string& folder, std::intmax_t bytes) const;
  [[nodiscard]] double work() const;
  [[nodiscard]] bool sleeps() const;

  pid_t child_ = -1;
  int terminal_ = -1;
  bool ended_ = false;
  std::string shown_;
  std::size_t seen_ = 0;  ///< of it, by wait_for()
};

/// Seconds since its construction.
class Watch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace boule::test
