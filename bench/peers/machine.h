#pragma once

#include <string>

namespace boule::bench {

/// What the figures were measured on and with.
struct Machine {
  std::string cpu;  ///< model
  unsigned cores;
  std::string compiler, flags;
  std::string embree;  ///< version
};

Machine this_machine();

}  // namespace boule::bench
