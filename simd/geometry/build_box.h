#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/scene/primitive.h"
#include "simd/abi/filter_bounds.h"

namespace boule {

/// Four floats, and four integers, in one register: GCC and Clang do arithmetic on these types on
/// every CPU. (GCC 12 does not vectorise loops over four floats by itself.)
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 load4(const float (&from)[4]) {
  Float4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return b < a ? a : b; }
/// Rounds toward zero.
inline Int4 truncate4(Float4 a) { return __builtin_convertvector(a, Int4); }

/// A sphere while the tree is built: centre, radius with its sign, and id.
struct BuildSphere {
  float at[4];
  std::int32_t id;
};

/// A range in each of four coordinates. Boxes use the first three; the range of centres and radii
/// has the radii as the fourth. By default it is empty.
struct BuildBox {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  Float4 low = {inf, inf, inf, inf}, high = {-inf, -inf, -inf, -inf};

  void add(const BuildBox& box) {
    low = min4(low, box.low);
    high = max4(high, box.high);
  }
  /// Half of the surface, in double, because boxes of 1e18 are squared. For an empty box the result
  /// is any number except NaN.
  [[nodiscard]] double area() const {
    const double x = double{high[0]} - double{low[0]}, y = double{high[1]} - double{low[1]};
    const double z = double{high[2]} - double{low[2]};
    return x * y + y * z + z * x;
  }
};

/// Whether float filters, rejects and boxes, can judge a sphere: its coordinates and its radius are
/// finite and below filter::limit. Other spheres go to the exact solver.
inline bool in_filter_range(const Sphere& s) {
  for (const float x : {s.center.x, s.center.y, s.center.z, s.radius}) {
    if (!(std::fabs(x) < filter::limit)) return false;  // NaN as well
  }
  return true;
}

/// The box of a sphere of centre (at[0], at[1], at[2]) and radius at[3], rounded to nearest:
/// accurate enough to weigh splits, too inaccurate to test rays.
inline BuildBox rough_box(Float4 at) {
  const float size = std::fabs(at[3]);
  const Float4 r = {size, size, size, size};
  return {at - r, at + r};
}
inline BuildBox rough_box(const BuildSphere& sphere) { return rough_box(load4(sphere.at)); }

/// The box that rays are tested against, slightly larger than the sphere (filter::box_step).
inline BuildBox outward_box(const BuildSphere& sphere) {
  const auto& at = sphere.at;
  BuildBox box;
  const double r = std::fabs(double{at[3]}) * (1 + filter::box_step);
  for (int k = 0; k < 3; ++k) {
    const double low = double{at[k]} - r, high = double{at[k]} + r;
    box.low[k] = static_cast<float>(low - std::fabs(low) * filter::box_step);
    box.high[k] = static_cast<float>(high + std::fabs(high) * filter::box_step);
  }
  box.low[3] = box.high[3] = 0;
  return box;
}

}  // namespace boule
