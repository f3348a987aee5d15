#include "simd/geometry/split.h"

#include <algorithm>
#include <bit>

namespace boule {
namespace {

/// The cost of one side of a cut, area times leaves, while bins are added to that side.
struct Sweep {
  BuildBox box;
  std::size_t count = 0;

  double add(const BuildBox& bin, std::size_t spheres) {
    box.add(bin);
    count += spheres;
    return count == 0 ? 0 : box.area() * static_cast<double>(leaves_of(count));
  }
};

/// 1 if a sphere goes left, otherwise 0: by the sign of a difference, because GCC makes a branch of
/// a comparison.
std::size_t is_left(const BinGrid& grid, const Cut& cut, const BuildSphere& sphere) {
  return static_cast<std::uint32_t>(grid.bin_of(sphere, cut.axis) - cut.bin) >> 31U;
}

}  // namespace

BinGrid::BinGrid(const BuildBox& extent) {
  // The result of bins_of() is rounded three times, and the farthest sphere must stay below `bins`.
  constexpr float all = static_cast<float>(bins) * (1 - 0x1p-20F);
  constexpr float least = 1e-30F;  // shorter axes would give an infinite scale
  for (int k = 0; k < 4; ++k) {
    const float length = extent.high[k] - extent.low[k];
    low_[k] = extent.low[k];
    scale_[k] = length > least ? all / length : 0;
  }
  const bool alike = extent.high[3] <= tuning::unlike_radii * extent.low[3];
  if (alike && (scale_[0] > 0 || scale_[1] > 0 || scale_[2] > 0)) scale_[3] = 0;
}

void Bins::add(const BinGrid& grid, std::span<const BuildSphere> spheres, std::size_t stride) {
  const int axes = grid.axes();
  for (std::size_t i = 0; i < spheres.size(); i += stride) {
    const BuildSphere& sphere = spheres[i];
    const BuildBox box = rough_box(sphere);
    const Int4 bin = grid.bins_of(sphere);
    const auto add_along = [&](int axis, int index) {
      boxes[axis][index].add(box);
      ++counts[axis][index];
    };
    add_along(0, bin[0]);
    add_along(1, bin[1]);
    add_along(2, bin[2]);
    if (axes > 3) add_along(3, bin[3]);
  }
}

void Bins::add(const Bins& bins) {
  for (int axis = 0; axis < 4; ++axis) {
    for (int bin = 0; bin < BinGrid::bins; ++bin) {
      boxes[axis][bin].add(bins.boxes[axis][bin]);
      counts[axis][bin] += bins.counts[axis][bin];
    }
  }
}

std::size_t stride_of(std::size_t spheres, const BinGrid& grid) {
  if (grid.axes() > 3) return 1;
  return std::bit_floor(
      std::clamp(spheres / tuning::cut_sample, std::size_t{1}, tuning::most_stride));
}

Cut best_cut(const Bins& bins, int axes) {
  Cut best;
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < axes; ++axis) {
    const auto& boxes = bins.boxes[axis];
    const auto& counts = bins.counts[axis];
    double right_cost[BinGrid::bins];
    Sweep right;
    for (int bin = BinGrid::bins - 1; bin > 0; --bin)
      right_cost[bin] = right.add(boxes[bin], counts[bin]);
    Sweep left;
    for (int bin = 1; bin < BinGrid::bins; ++bin) {
      const double cost = left.add(boxes[bin - 1], counts[bin - 1]) + right_cost[bin];
      const bool divides = left.count > 0 && right_cost[bin] > 0;
      if (divides && cost < least) {
        least = cost;
        best = {axis, bin};
      }
    }
  }
  return best;
}

BuildBox extent_of(std::span<const BuildSphere> spheres) {
  BuildBox extent;
  for (const BuildSphere& sphere : spheres) extent.add({load4(sphere.at), load4(sphere.at)});
  return extent;
}

std::size_t halve(std::span<BuildSphere> spheres, const BuildBox& extent) {
  const std::size_t middle = (leaves_of(spheres.size()) + 1) / 2 * bvh_leaf_size;
  int axis = 0;
  for (int k = 1; k < 4; ++k) {
    const bool longer = extent.high[k] - extent.low[k] > extent.high[axis] - extent.low[axis];
    if (longer && (k < 3 || extent.high[axis] == extent.low[axis])) axis = k;
  }
  if (extent.high[axis] == extent.low[axis]) return 0;
  std::nth_element(
      spheres.begin(), spheres.begin() + static_cast<std::ptrdiff_t>(middle), spheres.end(),
      [axis](const BuildSphere& a, const BuildSphere& b) { return a.at[axis] < b.at[axis]; });
  return middle;
}

std::size_t partition(std::span<BuildSphere> spheres, const BinGrid& grid, const Cut& cut,
                      std::span<BuildSphere> scratch) {
  std::size_t left = 0, right = 0;
  for (const BuildSphere sphere : spheres) {  // without a branch, because the side is unpredictable
    spheres[left] = sphere;
    scratch[right] = sphere;
    const std::size_t lefts = is_left(grid, cut, sphere);
    left += lefts;
    right += 1 - lefts;
  }
  std::copy_n(scratch.begin(), right, spheres.begin() + static_cast<std::ptrdiff_t>(left));
  return left;
}

std::size_t split(std::span<BuildSphere> spheres, std::span<BuildSphere> scratch) {
  const BuildBox extent = extent_of(spheres);
  const BinGrid grid(extent);
  const std::size_t stride = stride_of(spheres.size(), grid);
  const auto cut_by = [&](std::size_t apart) {
    Bins bins;
    bins.add(grid, spheres, apart);
    return best_cut(bins, grid.axes());
  };
  Cut cut = cut_by(stride);
  if (cut.axis < 0 && stride > 1) cut = cut_by(1);  // the sample had only copies of one sphere
  if (cut.axis < 0) return halve(spheres, extent);
  return partition(spheres, grid, cut, scratch);
}

}  // namespace boule
