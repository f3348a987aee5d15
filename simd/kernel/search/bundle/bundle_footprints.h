#pragma once

#include <bit>

#include "simd/abi/bvh.h"
#include "simd/kernel/search/bundle/bundle_extent.h"
#include "simd/kernel/search/bundle/bundle_rays.h"
#include "simd/kernel/tuning.h"

/// The decision whether a bundle pays. A bundle's visit of a leaf costs as much as the visits of
/// several single rays, so a leaf that serves fewer rays is better visited ray by ray. Only the
/// time depends on it, so plain float is enough here.
namespace boule::BOULE_KERNEL_ISA {

/// The average number of a bundle's rays per leaf: a leaf serves the fraction of rays that its box
/// has of the extent of all rays.
class Footprints {
 public:
  explicit Footprints(const BundleRays& rays)
      : rays_(static_cast<float>(rays.packets * width)),
        whole_((rays.extent.a_high - rays.extent.a_low) * (rays.extent.b_high - rays.extent.b_low)),
        enough_(rays_ / static_cast<float>(tuning::rays_per_leaf_judged)) {}

  /// Adds the leaves among a node's children in `in`, given as bits.
  BOULE_INLINE void add(const BvhNode& node, const BoxViews& views, unsigned in) {
    for (; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      if (node.leaf_size[k] == 0) continue;
      leaves_ += 1;
      area_ += views.area[k];
    }
  }
  /// Whether there were enough leaves to decide.
  [[nodiscard]] bool are_known() const { return enough_ <= leaves_; }
  /// Whether a leaf certainly serves fewer than `rays` rays. False where all rays of the bundle
  /// have the same a or b.
  [[nodiscard]] bool are_small(float rays) const {
    return are_known() && rays_ * area_ < rays * leaves_ * whole_;
  }

 private:
  float rays_, whole_, enough_;
  float leaves_ = 0, area_ = 0;
};

/// The number of nodes for which a test pauses after it proved useless.
class Pause {
 public:
  /// Whether the test pauses now; to be called once per node.
  BOULE_INLINE bool goes_on() {
    if (left_ == 0) return false;
    --left_;
    return true;
  }
  /// Records whether the test was of use this time.
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
