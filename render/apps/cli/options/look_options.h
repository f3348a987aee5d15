#pragma once

#include <CLI/CLI.hpp>

#include "render/apps/cli/options/options.h"

namespace boule::cli {

/// Above these options in the help.
inline constexpr const char* look_heading = "Particle files";

/// Adds the options that say what is read of a particle file.
void add_file_options(CLI::App& app, LookOptions& look);

/// Adds all options of a particle file, under a heading of their own. `look` must outlive `app`.
void add_look_options(CLI::App& app, LookOptions& look);

/// The same for those that hits depend on.
void add_shape_options(CLI::App& app, LookOptions& look);

/// What is wrong with them together, once they are parsed: options that need or exclude each
/// other; none if nothing is. Sets look.first and look.given.
std::optional<UsageError> check_look_options(const CLI::App& app, LookOptions& look);

}  // namespace boule::cli
