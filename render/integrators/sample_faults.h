#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/math/color.h"

namespace boule {

/// The number of samples that were not finite. All of them are counted before they enter a film.
struct SampleFaults {
  std::uint64_t not_finite = 0;  ///< with NaN in a component; they became black
  std::uint64_t too_bright = 0;  ///< with infinity in a component, which became the largest float

  SampleFaults& operator+=(const SampleFaults& other) {
    not_finite += other.not_finite;
    too_bright += other.too_bright;
    return *this;
  }
  [[nodiscard]] bool any() const { return not_finite > 0 || too_bright > 0; }
};

/// a b, but 0 if a factor is 0, even if the other is infinite: light of weight 0 is left out,
/// however bright it is.
inline float light_product(float a, float b) { return a == 0 || b == 0 ? 0 : a * b; }
inline Color light_product(const Color& a, const Color& b) {
  return {light_product(a.r, b.r), light_product(a.g, b.g), light_product(a.b, b.b)};
}

/// The finite form of a sample, for a film. Counts the faults of the sample.
inline Color settled(const Color& sample, SampleFaults& faults) {
  const auto& [r, g, b] = sample;
  // x - x is NaN if x is not finite, otherwise 0: one comparison checks three numbers.
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
