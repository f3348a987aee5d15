#pragma once

#include <string>

#include "core/base/error.h"
#include "render/cli/exit_code.h"

namespace boule::cli {

/// Writes to standard output: data only.
void print_data(const std::string& text);

/// A line for people, on standard error.
void print_note(const std::string& text);

/// The line of an error on standard error; returns `code`, for the caller to return.
ExitCode report(const Diagnostic& error, ExitCode code);

/// "boule: error: TEXT" and where help is to be found; returns wrong_usage.
ExitCode report_usage(const std::string& text);

}  // namespace boule::cli
