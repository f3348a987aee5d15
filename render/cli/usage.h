#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "render/cli/options.h"

namespace boule::cli {

/// What is wrong with a command line that CLI11 refused, in words that say what to type instead.
/// Words that nobody knows come first: what CLI11 finds missing is often what they were meant for.
UsageError explain_usage(const CLI::App& app, const CLI::ParseError& error);

/// There is no such command; the nearest one is named.
UsageError unknown_command(const CLI::App& app, const std::string& name);

}  // namespace boule::cli
