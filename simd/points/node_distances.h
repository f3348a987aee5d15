#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/math/vec.h"
#include "simd/abi/bvh.h"

namespace boule {

/// A distance as a number that rises with it: its square, and negative inside.
inline double key_of(double distance) { return distance > 0 ? distance * distance : distance; }

/// The key up to which boxes are looked at: that of a limit, and some more for rounding. `size`: of
/// the coordinates.
inline double limit_key(double limit, double size) {
  constexpr double share = 0x1p-48;
  return key_of(limit + share * (std::fabs(limit) + size)) + std::numeric_limits<double>::min();
}

/// The nodes and leaves of a tree around a point, the nearest first as far as boxes tell. A box
/// holds its primitives, so the point is at least as deep in the box as in any of them: the signed
/// distance of the box bounds those of all in it.

class NearNodes {
 public:
  NearNodes(const BvhView& bvh, const Vec3d& point) : nodes_(bvh.nodes), point_(point) {
    size_ = std::fabs(point.x) + std::fabs(point.y) + std::fabs(point.z) + double{bvh.extent};
    entries_[0] = {-std::numeric_limits<double>::infinity(), 0};
    count_ = 1;
  }

  /// Takes the next one, if there is any within the limit.
  bool take(double limit) {
    const double most = limit_key(limit, size_);
    while (count_ > 0) {
      current_ = entries_[--count_];
      if (!(current_.key > most)) return true;
    }
    return false;
  }

  /// Of the one that was taken.
  [[nodiscard]] bool is_leaf() const { return (current_.child & leaf_bit) != 0; }
  [[nodiscard]] std::uint32_t index() const { return index_of(current_.child); }

  /// Puts its children within the limit in its place. Precondition: it is a node.
  void open(double limit) {
    const BvhNode& node = nodes_[current_.child];
    alignas(64) std::array<double, bvh_width> keys;
    find_keys(node, keys.data());
    const double most = limit_key(limit, size_);
    std::size_t nearest = count_;
    for (std::size_t k = 0; k < node.size; ++k) {
      entries_[count_] = {keys[k], node.child[k]};
      if (keys[k] < entries_[nearest].key) nearest = count_;
      count_ += keys[k] <= most ? 1 : 0;
    }
    if (nearest < count_) std::swap(entries_[nearest], entries_[count_ - 1]);
  }

 private:
  struct Entry {
    double key;
    std::uint32_t child;
  };

  void find_keys(const BvhNode& node, double* keys) const {
    const auto larger = [](double a, double b) { return a > b ? a : b; };
    for (std::size_t k = 0; k < bvh_width; ++k) {
      const double x = larger(double{node.min_x[k]} - point_.x, point_.x - double{node.max_x[k]});
      const double y = larger(double{node.min_y[k]} - point_.y, point_.y - double{node.max_y[k]});
      const double z = larger(double{node.min_z[k]} - point_.z, point_.z - double{node.max_z[k]});
      const double depth = larger(x, larger(y, z));
      const double out_x = larger(x, 0), out_y = larger(y, 0), out_z = larger(z, 0);
      const double outside = out_x * out_x + out_y * out_y + out_z * out_z;
      keys[k] = depth > 0 ? outside : depth;
    }
  }

  const BvhNode* nodes_;
  Vec3d point_;
  double size_;
  std::size_t count_;
  Entry current_{};
  std::array<Entry, bvh_max_depth*(bvh_width - 1) + 2> entries_;
};

/// Which spheres of a block may be within a limit of a point.
class BlockDistances {
 public:
  BlockDistances(const SphereBlock& block, const Vec3d& point, double limit) {
    constexpr double share = 0x1p-46, least = 1e-150;
    const double wider = std::fabs(limit) * share + least;
    for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
      const double x = double{block.center_x[k]} - point.x;
      const double y = double{block.center_y[k]} - point.y;
      const double z = double{block.center_z[k]} - point.z;
      const double r = std::fabs(double{block.radius[k]});
      const double reach = (limit + r) + (r * share + wider);
      beyond_[k] = x * x + y * y + z * z - reach * std::fabs(reach);
    }
  }

  /// NaN, of an empty slot, is not near.
  [[nodiscard]] bool may_be_near(std::size_t k) const { return beyond_[k] <= 0; }

 private:
  alignas(64) std::array<double, bvh_leaf_size> beyond_;
};

}  // namespace boule
