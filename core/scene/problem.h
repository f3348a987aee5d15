#pragma once

#include <string>

namespace boule {

/// What is wrong with one field of one thing: "radius", "must be above 0, is -1". All the
/// find_problem() take any values, NaN and infinite ones, too few and too many; they throw
/// std::bad_alloc, and nothing else.
struct Problem {
  std::string field;
  std::string message;
};

}  // namespace boule
