#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/color.h"

namespace boule {

/// How many samples were no finite numbers. None of them enters a film unseen.
struct SampleFaults {
  std::uint64_t not_finite = 0;  ///< not a number, in any component: black
  std::uint64_t too_bright = 0;  ///< above the largest float in a component: that float

  SampleFaults& operator+=(const SampleFaults& other) {
    not_finite += other.not_finite;
    too_bright += other.too_bright;
    return *this;
  }
  [[nodiscard]] bool any() const { return not_finite > 0 || too_bright > 0; }
};

/// a b, where 0 times anything is 0: what does not count may be brighter than a float holds.
inline float light_product(float a, float b) { return a == 0 || b == 0 ? 0 : a * b; }
inline Color light_product(const Color& a, const Color& b) {
  return {light_product(a.r, b.r), light_product(a.g, b.g), light_product(a.b, b.b)};
}

/// A sample as a film holds it, which is finite; what is wrong with it is counted.
inline Color settled(const Color& sample, SampleFaults& faults) {
  const auto& [r, g, b] = sample;
  // x - x is 0, or NaN where x is not finite: one comparison for three numbers.
  if ((r - r) + (g - g) + (b - b) == 0) return sample;
  if (std::isnan(r) || std::isnan(g) || std::isnan(b)) {
    ++faults.not_finite;
    return {};
  }
  ++faults.too_bright;
  constexpr float largest = std::numeric_limits<float>::max();
  return {std::min(r, largest), std::min(g, largest), std::min(b, largest)};
}

}  // namespace boule
