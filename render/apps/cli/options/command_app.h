#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace boule::cli {

/// Shows `visit` the commands and options that parse_command_line() takes.
void visit_commands(const std::function<void(const CLI::App&)>& visit);

}  // namespace boule::cli
