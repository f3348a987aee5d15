#pragma once

#include <CLI/CLI.hpp>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"

namespace boule::cli {

/// The options of long runs and of those that are shared out: --checkpoint, --resume, --shard,
/// --claim, --mpi.
void add_part_options(CLI::App& app, RenderCommand& command);

/// The options of `boule merge`.
void add_merge(CLI::App& app, MergeCommand& command);

/// "FILE" or "FILE,TIME", FILE not empty.
std::optional<TimedFile> parse_timed_file(const std::string& text);

/// "K/N", 1 <= K <= N <= 1000000.
std::optional<Shard> parse_shard(const std::string& text);

/// Errors in how these options go together and with others.
Status check_part_options(const RenderCommand& command);

}  // namespace boule::cli
