#pragma once

#include <CLI/CLI.hpp>

#include "render/apps/cli/options/options.h"

namespace boule::cli {

/// Adds the arguments and options of `boule pack`. `command` must outlive `app`.
void add_pack(CLI::App& app, PackCommand& command);

}  // namespace boule::cli
