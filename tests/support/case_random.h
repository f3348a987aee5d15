#pragma once

#include <cmath>
#include <cstdint>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "core/math/random.h"

namespace boule::test {

/// A seeded sequence of draws. Draw into named values, one a statement: the order of evaluation of
/// a call's arguments is not defined.
class CaseRandom {
 public:
  /// Different streams of one seed are independent: item i of a case is the same in a case of any
  /// size.
  explicit CaseRandom(std::uint64_t seed, std::uint64_t stream = 0)
      : seed_(seed), stream_(stream) {}

  /// In [0, 1).
  double uniform() {
    const auto words =
        philox({count_++, static_cast<std::uint32_t>(stream_),
                static_cast<std::uint32_t>(stream_ >> 32), 0},
               {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
    return (words[0] + words[1] * 0x1p-32) * 0x1p-32;
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  int below(int count) { return static_cast<int>(uniform() * count); }
  bool chance(double probability) { return uniform() < probability; }
  /// Log-uniform in [10^low, 10^high).
  double decade(double low, double high) { return elementary::pow(10, uniform(low, high)); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

  /// Uniform on the unit sphere.
  Vec3d direction() {
    for (;;) {
      const double x = uniform(-1, 1);
      const double y = uniform(-1, 1);
      const double z = uniform(-1, 1);
      const double squared = x * x + y * y + z * z;
      if (squared > 1e-3 && squared <= 1) return Vec3d{x, y, z} * (1 / std::sqrt(squared));
    }
  }
  /// A unit vector at right angles to the unit vector w.
  Vec3d perpendicular(const Vec3d& w) {
    for (;;) {
      const Vec3d v = direction();
      const Vec3d across = cross(w, v);
      if (length(across) > 0.1) return normalize(across);
    }
  }

 private:
  std::uint64_t seed_, stream_;
  std::uint32_t count_ = 0;
};

}  // namespace boule::test
