#pragma once

#include <bit>

#include "simd/abi/bvh.h"
#include "simd/kernel/search/bundle_extent.h"
#include "simd/kernel/search/bundle_rays.h"
#include "simd/kernel/tuning.h"

/// Whether a bundle pays. Its visit of a leaf costs as much as some of its rays would pay for a
/// visit of their own; where a leaf is for fewer of them they had better go one by one. Only the
/// time depends on it, so everything here is plain float.
namespace boule::BOULE_KERNEL_ISA {

/// How many of a bundle's rays a leaf is for, on average: as many as its box has of the extent of
/// all rays.
class Footprints {
 public:
  explicit Footprints(const BundleRays& rays)
      : rays_(static_cast<float>(rays.packets * width)),
        whole_((rays.extent.a_high - rays.extent.a_low) * (rays.extent.b_high - rays.extent.b_low)),
        enough_(rays_ / static_cast<float>(tuning::rays_per_leaf_judged)) {}

  /// Adds those of a node's children in `in`, as bits, that are leaves.
  BOULE_INLINE void add(const BvhNode& node, const BoxViews& views, unsigned in) {
    for (; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      if (node.leaf_size[k] == 0) continue;
      leaves_ += 1;
      area_ += views.area[k];
    }
  }
  /// Whether there were enough leaves to tell.
  [[nodiscard]] bool are_known() const { return enough_ <= leaves_; }
  /// Whether it is certain that a leaf is for fewer rays than that. Not where all have the same a
  /// or b.
  [[nodiscard]] bool are_small(float rays) const {
    return are_known() && rays_ * area_ < rays * leaves_ * whole_;
  }

 private:
  float rays_, whole_, enough_;
  float leaves_ = 0, area_ = 0;
};

/// For how many nodes something is left out that turned out to be no use.
class Pause {
 public:
  /// Whether it is left out now; to be asked once for each node.
  BOULE_INLINE bool goes_on() {
    if (left_ == 0) return false;
    --left_;
    return true;
  }
  /// Says whether it was of use this time.
  BOULE_INLINE void look(bool was_of_use) {
    length_ = was_of_use                            ? 0
              : length_ < tuning::most_nodes_paused ? 2 * length_ + 1
                                                    : tuning::most_nodes_paused;
    left_ = length_;
  }

 private:
  int length_ = 0, left_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
