#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"
#include "simd/abi/bvh.h"
#include "simd/geometry/geometry.h"
#include "simd/points/point_distance.h"
#include "simd/points/sphere_blocks.h"

namespace boule {

struct SpherePair {
  std::int32_t first, second;
  double gap;
};

/// Finds the pairs of spheres whose gap is at most a limit, block by block. Float rejects the
/// others where it can be sure: docs/numerics.md.
class PairFinder {
 public:
  /// Precondition: the gap is not NaN.
  PairFinder(const Geometry& geometry, const GeometryView& view, double gap);

  /// Appends the pairs of the spheres of a block with one another, and with those of later blocks.
  void find(std::size_t block, std::vector<SpherePair>& pairs);

 private:
  /// Spheres that may be near some of the block, in blocks; those of the block itself come first.
  struct Candidates {
    std::vector<SphereBlock> blocks;
    std::vector<std::int32_t> ids;
  };

  void take(const PlacedBlock& block, std::uint32_t slots);
  std::size_t gather(std::size_t block);
  template <class Square>
  [[nodiscard]] std::uint32_t near_slots(const SphereBlock& spheres, float radius,
                                         const Square& square) const;
  void add(std::int32_t a, std::int32_t b, double gap, std::vector<SpherePair>& pairs) const;

  const Geometry& geometry_;
  SphereBlocks blocks_;
  double gap_;
  float float_gap_;  ///< the gap and some more, for float
  Candidates candidates_;
};

}  // namespace boule
