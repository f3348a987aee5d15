#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "render/apps/cli/options/options.h"

namespace boule::cli {

/// Explains why CLI11 refused a command line, in words that say what to type instead. Unknown words
/// are explained before missing options: often an unknown word was meant for the missing option.
UsageError explain_usage(const CLI::App& app, const CLI::ParseError& error);

/// The error for a command that there is not; it names the nearest one.
UsageError unknown_command(const CLI::App& app, const std::string& name);

}  // namespace boule::cli
