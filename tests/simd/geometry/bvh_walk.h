#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simd/abi/isa.h"
#include "simd/geometry/bvh_builder.h"

namespace boule::test {

/// What walking a whole tree tells.
struct Walk {
  const Bvh& bvh;
  const std::vector<Sphere>& spheres;
  int depth = 0;
  std::size_t leaves = 0, in_leaves = 0;

  /// Whether a box's range holds that of a sphere. Below 2^-126, where floats are 2^-149 apart, it
  /// may be half a step too narrow (filter_bounds.h).
  static bool holds(float low, float high, float center, double r) {
    const double least = double{center} - r, most = double{center} + r;
    const auto lost = [](double x) { return std::fabs(x) < 0x1p-126 ? 0x1p-149 : 0; };
    return double{low} < least + lost(least) && most - lost(most) < double{high};
  }
  static bool holds(const BvhNode& node, std::size_t k, const Sphere& s) {
    const double r = std::fabs(double{s.radius});
    return holds(node.min_x[k], node.max_x[k], s.center.x, r) &&
           holds(node.min_y[k], node.max_y[k], s.center.y, r) &&
           holds(node.min_z[k], node.max_z[k], s.center.z, r);
  }
  /// Visits node `index`; returns the slots below it.
  std::vector<std::int32_t> below(std::size_t index, int level) {
    depth = std::max(depth, level);
    const BvhNode& node = bvh.nodes[index];
    EXPECT_GE(node.size, 1);
    EXPECT_LE(node.size, bvh_width);
    std::vector<std::int32_t> all;
    for (std::size_t k = 0; k < node.size; ++k) {
      std::vector<std::int32_t> some;
      if (node.leaf_size[k] > 0) {
        EXPECT_LE(node.leaf_size[k], bvh_leaf_size);
        ++leaves;
        in_leaves += node.leaf_size[k];
        for (std::size_t i = 0; i < node.leaf_size[k]; ++i)
          some.push_back(bvh.slots[bvh.scanned + index_of(node.child[k]) * bvh_leaf_size + i]);
      } else {
        EXPECT_GT(node.child[k], index);  // children come later: no loops
        some = below(node.child[k], level + 1);
      }
      for (const std::int32_t id : some) {
        EXPECT_TRUE(holds(node, k, spheres.at(static_cast<std::size_t>(id)))) << id;
      }
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }
};

/// Whether two spheres have the same centre and the same radius, or are NaN in the same way.
inline bool are_copies(const Sphere& a, const Sphere& b) {
  const auto same = [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return same(a.center.x, b.center.x) && same(a.center.y, b.center.y) &&
         same(a.center.z, b.center.z) && same(a.radius, b.radius);
}

/// Checks that each sphere is found once; but for exact copies of two that are found, of lower ids.
inline void check_found(const std::vector<std::int32_t>& found,
                        const std::vector<Sphere>& spheres) {
  std::vector<bool> is_found(spheres.size());
  for (const std::int32_t id : found) {
    ASSERT_FALSE(is_found.at(static_cast<std::size_t>(id))) << id << " is there twice";
    is_found[static_cast<std::size_t>(id)] = true;
  }
  std::vector<std::size_t> originals;  // the second ones of those left out, few
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (is_found[i]) continue;
    const auto copied = [&](std::size_t k) { return are_copies(spheres[k], spheres[i]); };
    if (std::any_of(originals.begin(), originals.end(), copied)) continue;
    int kept = 0;
    for (std::size_t k = 0; k < i && kept < 2; ++k) {
      if (!is_found[k] || !copied(k)) continue;
      if (++kept == 2) originals.push_back(k);
    }
    ASSERT_EQ(kept, 2) << i << " is lost";
  }
}

/// Checks everything that makes a tree valid and returns its figures.
inline Walk check(const Bvh& bvh, const std::vector<Sphere>& spheres) {
  Walk walk{bvh, spheres};
  EXPECT_EQ(bvh.scanned % max_width, 0U);
  EXPECT_EQ((bvh.slots.size() - bvh.scanned) % bvh_leaf_size, 0U);
  std::vector<std::int32_t> found(bvh.slots.begin(), bvh.slots.begin() + bvh.scanned);
  if (!bvh.nodes.empty()) {
    const std::vector<std::int32_t> below = walk.below(0, 1);
    found.insert(found.end(), below.begin(), below.end());
  }
  std::erase(found, empty_slot);
  check_found(found, spheres);
  EXPECT_LE(walk.depth, bvh_max_depth);
  return walk;
}

}  // namespace boule::test
