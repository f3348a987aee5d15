#pragma once

#include <string>

namespace boule {

/// An error in one field of a struct: "radius", "must be above 0, is -1". Every find_problem()
/// takes any values, NaN and infinities included, and lists of any length. The only exception it
/// throws is std::bad_alloc.
struct Problem {
  std::string field{};
  std::string message{};
};

}  // namespace boule
