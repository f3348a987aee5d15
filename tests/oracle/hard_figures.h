#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tests/oracle/oracle.h"

namespace boule::test {

/// The distance from |x| to the next float above, its size being a normal or denormal float's.
double ulp_of(double x);

/// The errors of a contender on the pairs of a case, in three columns: decisions and roots, ulp of
/// t, distance from the surface. The scale is max(F, r), F = |o - c| or |o - p0|; of a capsule
/// max(F, L, r), F = |o - a|, L = |b - a|.
class HardFigures {
 public:
  /// Adds one ray against one primitive. `t` is the contender's, in double; inf is a miss.
  template <class Primitive>
  void add(const Ray& ray, const Primitive& primitive, double t,
           const std::optional<OracleHit>& truth);

  std::size_t pairs = 0, hits = 0;
  std::size_t wrong_decisions = 0;  ///< a hit for a miss or a miss for a hit
  std::size_t wrong_roots = 0;      ///< nearer to the other root of a sphere or capsule
  double max_far_ulp = 0;           ///< error of float t in ulp where |t||d| > 2^-20 scale
  /// The same without rays that graze a sphere so closely that a double's error of the
  /// discriminant, about 2^-52 r scale, or of cc, 2^-52 scale^2, moves t by that much: with h half
  /// the chord, where h |t||d| > 2^-21 r scale and |t t'||d|^2 > 2^-22 scale^2. Of a capsule that
  /// is where |t||d| cos > 2^-20 scale, with the angle of the ray to the normal where it meets it.
  double max_clear_ulp = 0;
  double max_residual = 0;    ///< of float t, in u scale
  double max_residual64 = 0;  ///< of the double t, in 2^-48 scale
  double max_excess = 0;      ///< residual of float t over 0.5 ulp(t)|d| + 2^-48 scale

  /// The p-quantile of the error of float t in ulp, over all hits; 0 where there are none.
  [[nodiscard]] double ulp_quantile(double p);

 private:
  std::vector<double> ulps_;
};

}  // namespace boule::test
