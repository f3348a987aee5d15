#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/run_program.h"
#include "tests/support/temp_dir.h"

namespace boule::test {

/// Where a program is held until it is let go or a signal ends it: see hold_injector.cpp.
struct Hold {
  std::string call;        ///< "open", "read", "write", "thread" or "say"
  std::string file;        ///< its path, or how that begins; the text of "say"
  int number = 1;          ///< which of these calls
  std::string after = {};  ///< counted from when this was said; empty: from the start
};

/// The built program while it runs on a terminal of its own (a pty), which is its standard input,
/// output and error. Killed at the end if it still runs, and where it makes a test wait for more
/// than two minutes: that is a failure of the test, with what was shown so far.
class RunningProgram {
 public:
  /// A terminal of so many columns.
  explicit RunningProgram(const std::vector<std::string>& arguments, unsigned short columns = 100);
  RunningProgram(const std::vector<std::string>& arguments, const Hold& hold);
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();

  /// Reads until what was shown, after what was waited for before, fulfils `condition`, which gives
  /// the place behind it or npos; false if the program ends first.
  bool wait_until(
      const std::function<std::size_t(const std::string& shown, std::size_t from)>& condition);
  /// Until `text` was shown.
  bool wait_for(const std::string& text);

  /// Reads until the program is held where it was to be; false if it ends before.
  bool wait_for_hold();
  void let_go();

  void send(int signal) const;

  /// Reads to the end: the exit code, and all that was shown as `out`, each line ended by "\r\n".
  ProgramRun finish();

 private:
  using Clock = std::chrono::steady_clock;

  void start(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
             unsigned short columns);
  bool read_some(Clock::time_point limit, int timeout_ms);
  void give_up();
  [[nodiscard]] std::string gate() const { return (folder_.path() / "gate").string(); }

  TempDir folder_;
  pid_t child_ = -1;
  int terminal_ = -1;
  int gate_ = -1;  ///< open for writing while the program is held
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
