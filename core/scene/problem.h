#pragma once

#include <string>

namespace boule {

/// What is wrong with one field of a struct: "radius", "must be above 0, is -1". Every
/// find_problem() takes any values, NaN and infinities among them, and lists of any length. The
/// only exception it throws is std::bad_alloc.
struct Problem {
  std::string field{};
  std::string message{};
};

}  // namespace boule
