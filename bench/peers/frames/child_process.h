#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"

namespace boule::bench {

/// What a program took from its start to its end, in seconds.
struct ChildTimes {
  double cpu = 0;   ///< user and system
  double wall = 0;  ///< on the clock
};

/// Where the program of this name is by PATH; empty if it is not installed.
std::string find_program(const std::string& name);

/// Runs `command`, a program's path and its arguments, to its end; what it says goes to the file
/// `log`. An error if it cannot be run or fails.
Result<ChildTimes> run_child(const std::vector<std::string>& command, const std::string& log);

}  // namespace boule::bench
