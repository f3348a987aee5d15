#pragma once

#include <string>

#include "core/base/error.h"
#include "render/cli/options.h"

namespace boule::cli {

/// What is known to be wrong with an output before there is anything to write: its folder is not
/// there or not writable, it is a folder, it may not be replaced. The error is the one that writing
/// would end with. Nothing is created that stays, nothing is waited for: a pipe's reader may come
/// later.
Status check_output(const std::string& name);

/// The same for the statistics of a run, a file or standard output.
Status check_stats_target(const StatsTarget& target);

}  // namespace boule::cli
