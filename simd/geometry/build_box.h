#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/abi/filter_bounds.h"
#include "simd/geometry/float4.h"

namespace boule {

/// A sphere while the tree is built: centre and radius, and which one it is.
struct BuildSphere {
  float at[4];
  std::int32_t id;
};

/// The range of four coordinates, the fourth for a radius or for nothing. The default one is empty.
struct BuildBox {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  Float4 low = {inf, inf, inf, inf}, high = {-inf, -inf, -inf, -inf};

  void add(const BuildBox& box) {
    low = min4(low, box.low);
    high = max4(high, box.high);
  }
  /// Half of the surface, in double: boxes of 1e18 square well. Of an empty one anything, not NaN.
  [[nodiscard]] double area() const {
    const double x = double{high[0]} - double{low[0]}, y = double{high[1]} - double{low[1]};
    const double z = double{high[2]} - double{low[2]};
    return x * y + y * z + z * x;
  }
};

/// A box around a sphere of centre (at[0], at[1], at[2]) and radius at[3], rounded to nearest: what
/// splits are weighed by.
inline BuildBox rough_box(Float4 at) {
  const Float4 r = {at[3], at[3], at[3], at[3]};
  return {at - r, at + r};
}
inline BuildBox rough_box(const BuildSphere& sphere) { return rough_box(load4(sphere.at)); }

/// The box that is tested, wider than the sphere: see filter_bounds.h.
inline BuildBox outward_box(const BuildSphere& sphere) {
  const auto& at = sphere.at;
  BuildBox box;
  const double r = double{at[3]} * (1 + filter::box_step);
  for (int k = 0; k < 3; ++k) {
    const double low = double{at[k]} - r, high = double{at[k]} + r;
    box.low[k] = static_cast<float>(low - std::fabs(low) * filter::box_step);
    box.high[k] = static_cast<float>(high + std::fabs(high) * filter::box_step);
  }
  box.low[3] = box.high[3] = 0;
  return box;
}

}  // namespace boule
