#pragma once

#include <cstdio>
#include <string>

namespace boule {

/// A number for an error message: six digits at most. Throws std::bad_alloc.
inline std::string number_text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

}  // namespace boule
