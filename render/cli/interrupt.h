#pragma once

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

/// Says that the output is in place: from now on "nothing written" would be wrong. `end` is what
/// the line says instead, a literal such as "the picture had been written".
void set_written(const char* end);

/// Says whether a line without its end stands on the terminal: a signal's message ends it first.
void set_line_open(bool open);

/// Ends the program as the handler would have, if a signal came while a WriteGuard lived.
void exit_if_interrupted();

}  // namespace boule::cli
