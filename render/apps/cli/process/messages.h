#pragma once

#include <cstddef>
#include <string>

#include "core/base/error.h"
#include "render/apps/cli/process/exit_code.h"

namespace boule::cli {

/// Writes to standard output: data only. That nobody reads them any more is no error: the reader
/// has closed the pipe, as `head` does.
Status print_data(const std::string& text);
/// Whether that was so.
bool reader_left();

/// print_data() for a command that does nothing else. Returns done, or reports the error and
/// returns failed. Ends the program where nobody reads (leave_unread()).
ExitCode print_as_result(const std::string& text);

/// A line for people, on standard error.
void print_note(const std::string& text);

/// "1 sphere", "2 spheres".
std::string counted(std::size_t count, const std::string& noun);

/// The line of an error on standard error; returns `code`, for the caller to return.
ExitCode report(const Diagnostic& error, ExitCode code);

/// "boule: error: TEXT" and the command that helps; returns wrong_usage.
ExitCode report_usage(const std::string& text, const std::string& help);

}  // namespace boule::cli
