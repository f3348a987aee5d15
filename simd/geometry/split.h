#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/abi/bvh.h"
#include "simd/geometry/build_box.h"
#include "simd/geometry/tuning.h"

namespace boule {

/// Leaves that so many spheres need.
constexpr std::size_t leaves_of(std::size_t spheres) {
  return (spheres + bvh_leaf_size - 1) / bvh_leaf_size;
}

/// Which bin a sphere belongs to along each axis: by its centre along x, y and z, and by its radius
/// along a fourth axis where the radii differ much (tuning::unlike_radii).
class BinGrid {
 public:
  static constexpr int bins = tuning::bins;

  BinGrid() = default;
  /// `extent`: the range of the spheres' centres and radii.
  explicit BinGrid(const BuildBox& extent);

  /// The bins along the four axes, 0 .. bins - 1; always 0 where an axis cannot be divided.
  [[nodiscard]] Int4 bins_of(const BuildSphere& sphere) const {
    return truncate4((load4(sphere.at) - low_) * scale_);
  }
  /// The same for one axis.
  [[nodiscard]] int bin_of(const BuildSphere& sphere, int axis) const {
    return static_cast<int>((sphere.at[axis] - low_[axis]) * scale_[axis]);
  }
  /// 3, or 4 if radii are considered.
  [[nodiscard]] int axes() const { return scale_[3] > 0 ? 4 : 3; }

 private:
  Float4 low_ = {}, scale_ = {};
};

/// What lies in each bin: boxes and counts, which do not depend on the order of adding.
struct Bins {
  BuildBox boxes[4][BinGrid::bins];
  std::size_t counts[4][BinGrid::bins] = {};

  /// Adds the first sphere and then every stride-th one.
  void add(const BinGrid& grid, std::span<const BuildSphere> spheres, std::size_t stride = 1);
  void add(const Bins& bins);
};

/// Where to cut: spheres whose bin along `axis` is below `bin` go left. Axis -1: nothing divides
/// them.
struct Cut {
  int axis = -1, bin = 0;
};

/// How far the spheres are from each other by which so many are cut: a power of two. 1 where radii
/// differ, because few large spheres among many small ones must not be missed.
std::size_t stride_of(std::size_t spheres, const BinGrid& grid);

/// The cut of the least cost by the surface area heuristic: the sum over both sides of area times
/// leaves.
Cut best_cut(const Bins& bins, int axes);

/// Brings the spheres on the left of a cut before the others. On each side they keep their order.
/// `scratch` has as much room as there are spheres. Returns how many are on the left.
std::size_t partition(std::span<BuildSphere> spheres, const BinGrid& grid, const Cut& cut,
                      std::span<BuildSphere> scratch);

/// The range of centres and radii.
BuildBox extent_of(std::span<const BuildSphere> spheres);

/// Divides more spheres than fit into a leaf into two parts, by the surface area heuristic over
/// binned centres (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007) and
/// returns the size of the first: never all, and 0 only where all are copies of one sphere.
/// `scratch` has as much room as there are spheres.
std::size_t split(std::span<BuildSphere> spheres, std::span<BuildSphere> scratch);

/// Divides the spheres in the middle of the longest axis, so that the first part fills whole
/// leaves, and returns the size of that part; 0 where all are copies of one sphere.
std::size_t halve(std::span<BuildSphere> spheres, const BuildBox& extent);

}  // namespace boule
