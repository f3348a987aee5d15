#pragma once

#include <string>

namespace boule::cli {

/// Writes whole lines to standard error, on any thread. It first wipes away a line that draw_line()
/// left open.
void write_lines(const std::string& lines);

/// From now on lines are kept instead of written: another process will tell them.
void keep_lines();
/// The lines that were kept.
std::string kept_lines();

/// Rewrites the last line of the terminal on standard error, which stays open: no end of line
/// yet. Cut to the terminal's width.
void draw_line(std::string line);

/// Ends a line that draw_line() left open.
void end_drawn_line();

/// Columns of the terminal on standard error, 80 if it does not tell.
std::size_t terminal_columns();

/// Writes the process's last line to standard error, after ending one that is open: no other line
/// can follow it. It is cut to 400 bytes. The function is async-signal-safe and needs no memory.
void write_last_line(const char* line);

}  // namespace boule::cli
