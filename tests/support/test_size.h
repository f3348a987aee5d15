#pragma once

#include <cstddef>
#include <cstdlib>

namespace boule::test {

/// The size of a test that has two: the environment variable's, which `ctest -L long` sets, else
/// the daily one.
inline std::size_t test_size(const char* variable, std::size_t every_day) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? every_day : std::strtoul(text, nullptr, 10);
}

}  // namespace boule::test
