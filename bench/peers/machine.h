#pragma once

#include <string>

namespace boule::bench {

/// The machine and the libraries that the figures were measured with.
struct Machine {
  std::string cpu;  ///< model
  unsigned cores;
  std::string compiler, flags;
  std::string embree;  ///< version
};

Machine this_machine();

}  // namespace boule::bench
