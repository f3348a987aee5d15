#pragma once

#include <string>

#include "core/base/error.h"
#include "render/apps/cli/options/options.h"

namespace boule::cli {

/// Checks an output before the work: an error if its folder is not there or not writable, if it is
/// a folder itself, or if it may not be replaced. The error is the one that writing would end with.
/// The check leaves no file behind and does not wait for a pipe's reader, who may come later.
Status check_output(const std::string& name);

/// An error if nothing can be written to standard output.
Status check_standard_output();

/// check_output() for the statistics of a run, which go to a file or standard output.
Status check_stats_target(const StatsTarget& target);

}  // namespace boule::cli
