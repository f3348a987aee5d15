#pragma once

#include <cstddef>
#include <cstdlib>

namespace boule::test {

/// How much a test with two sizes does: what the environment says (`ctest -L long` sets it), else
/// the size for every day.
inline std::size_t test_size(const char* variable, std::size_t every_day) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? every_day : std::strtoul(text, nullptr, 10);
}

}  // namespace boule::test
