#pragma once

#include <CLI/CLI.hpp>

#include "render/apps/cli/options/options.h"
#include "render/apps/view/messages/view_settings.h"

namespace boule::cli {

/// Adds the options of the server of `boule view`. `view` must outlive `app`.
void add_view_options(CLI::App& app, ViewCommand& view);

}  // namespace boule::cli
