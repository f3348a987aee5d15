#pragma once

#include <CLI/CLI.hpp>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"

namespace boule::cli {

/// What `boule trace` is asked about: --rays, --points, --pairs, and what about them.
void add_questions(CLI::App& app, TraceCommand& command);

/// Errors in how these options go together.
Status check_questions(const TraceCommand& command);

}  // namespace boule::cli
