#pragma once

#include <algorithm>
#include <vector>

namespace boule::bench {

/// The middle one of some values, at least one; of an even number the greater of the two.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace boule::bench
