#pragma once

namespace boule::cli {

/// Makes SIGINT, SIGTERM and SIGHUP end the program at once with "boule: interrupted (SIGTERM),
/// nothing written" and exit status 128 + n: right from the signal's handler, except while a
/// WriteGuard lives. Where the picture had been written already the line says that instead.
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

/// Says that the picture is in place: from now on "nothing written" would be wrong.
void set_picture_written();

/// Says whether a line without its end stands on the terminal: a signal's message ends it first.
void set_line_open(bool open);

/// Ends the program as the handler would have, if a signal came while a WriteGuard lived.
void exit_if_interrupted();

}  // namespace boule::cli
