#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "simd/abi/bvh.h"
#include "simd/geometry/build_box.h"
#include "simd/geometry/tuning.h"

namespace boule {

/// The number of leaves for this many spheres.
constexpr std::size_t leaves_of(std::size_t spheres) {
  return (spheres + bvh_leaf_size - 1) / bvh_leaf_size;
}

/// The bin of a sphere along each axis: by its centre along x, y and z, and by its radius along a
/// fourth axis if the radii differ much (tuning::unlike_radii).
class BinGrid {
 public:
  static constexpr int bins = tuning::bins;

  BinGrid() = default;
  /// `extent`: the range of the spheres' centres and radii.
  explicit BinGrid(const BuildBox& extent);

  /// The bins along the four axes, 0 .. bins - 1; always 0 along an axis that cannot be divided.
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

/// The contents of each bin: boxes and counts, which are independent of the order of adding.
struct Bins {
  BuildBox boxes[4][BinGrid::bins];
  std::size_t counts[4][BinGrid::bins] = {};

  /// Adds the first sphere and then every stride-th one.
  void add(const BinGrid& grid, std::span<const BuildSphere> spheres, std::size_t stride = 1);
  void add(const Bins& bins);
};

/// A cut: spheres whose bin along `axis` is below `bin` go left. Axis -1: all spheres share their
/// bins.
struct Cut {
  int axis = -1, bin = 0;
};

/// The distance, a power of two, between the spheres of the sample that decides the cut. 1 where
/// radii differ, because the sample could miss few large spheres among many small ones.
std::size_t stride_of(std::size_t spheres, const BinGrid& grid);

/// The cut of the least cost by the surface area heuristic: the sum over both sides of area times
/// leaves.
Cut best_cut(const Bins& bins, int axes);

/// Moves the spheres on the left of a cut before the others and keeps the order on each side.
/// `scratch` has room for all spheres. Returns the number on the left.
std::size_t partition(std::span<BuildSphere> spheres, const BinGrid& grid, const Cut& cut,
                      std::span<BuildSphere> scratch);

/// The range of centres and radii.
BuildBox extent_of(std::span<const BuildSphere> spheres);

/// Divides more spheres than fit into a leaf into two parts, by the surface area heuristic over
/// binned centres (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
/// Returns the size of the first part: always less than all, and 0 only if all are copies of one
/// sphere. `scratch` has room for all spheres.
std::size_t split(std::span<BuildSphere> spheres, std::span<BuildSphere> scratch);

/// Divides the spheres in the middle of the longest axis, so that the first part fills whole
/// leaves. Returns the size of that part; 0 if all are copies of one sphere.
std::size_t halve(std::span<BuildSphere> spheres, const BuildBox& extent);

}  // namespace boule
