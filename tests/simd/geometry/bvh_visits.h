#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/math/geometry.h"
#include "simd/geometry/bvh_builder.h"
#include "tests/support/case_random.h"

namespace boule::test {

/// Nodes and leaves that a ray visits.
struct Visits {
  double nodes = 0, leaves = 0;
};

/// A ray on its way through a tree: the nearest child first, as far as its nearest hit, in double.
struct VisitingRay {
  const Bvh& bvh;
  const std::vector<Sphere>& spheres;
  Vec3d org, dir;  ///< dir is of unit length
  double limit = std::numeric_limits<double>::infinity();
  Visits visits = {};

  void run() {
    for (std::size_t slot = 0; slot < bvh.scanned; ++slot) meet(slot);
    if (!bvh.nodes.empty()) visit(0);
  }
  [[nodiscard]] bool hits() const { return std::isfinite(limit); }

  void meet(std::size_t slot) {
    if (bvh.slots[slot] < 0) return;
    const Sphere& s = spheres[static_cast<std::size_t>(bvh.slots[slot])];
    const Vec3d f = vec_cast<double>(s.center) - org;
    const double b = dot(f, dir), r = double{s.radius};
    const double discriminant = b * b - dot(f, f) + r * r;
    if (!(discriminant >= 0)) return;
    for (const double t : {b - std::sqrt(discriminant), b + std::sqrt(discriminant)})
      if (t > 0) limit = std::min(limit, t);
  }
  /// Where the ray enters child k; inf where it does not.
  [[nodiscard]] double entry(const BvhNode& node, std::size_t k) const {
    double near = 0, far = std::numeric_limits<double>::infinity();
    const auto cut = [&](float low, float high, double from, double along) {
      const double a = (double{low} - from) / along, b = (double{high} - from) / along;
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    };
    cut(node.min_x[k], node.max_x[k], org.x, dir.x);
    cut(node.min_y[k], node.max_y[k], org.y, dir.y);
    cut(node.min_z[k], node.max_z[k], org.z, dir.z);
    return near <= far ? near : std::numeric_limits<double>::infinity();
  }
  void visit(std::size_t index) {
    ++visits.nodes;
    const BvhNode& node = bvh.nodes[index];
    double entries[bvh_width];
    std::size_t order[bvh_width];
    for (std::size_t k = 0; k < node.size; ++k) {
      entries[k] = entry(node, k);
      order[k] = k;
    }
    std::sort(order, order + node.size,
              [&](std::size_t a, std::size_t b) { return entries[a] < entries[b]; });
    for (const std::size_t k : std::span(order).first(node.size)) {
      if (!(entries[k] < limit)) break;
      if (node.leaf_size[k] == 0) {
        visit(node.child[k]);
        continue;
      }
      ++visits.leaves;
      for (std::size_t i = 0; i < node.leaf_size[k]; ++i)
        meet(bvh.scanned + index_of(node.child[k]) * bvh_leaf_size + i);
    }
  }
};

/// The mean over rays that come from all around, `distance` away, to one of the first `targets`
/// spheres each, and hit something.
inline Visits mean_visits(const Bvh& bvh, const std::vector<Sphere>& spheres, std::size_t targets,
                          double distance) {
  constexpr int count = 1000;
  CaseRandom random(22);
  Visits sum;
  for (int i = 0; i < count; ++i) {
    const Sphere& target =
        spheres[static_cast<std::size_t>(random.below(static_cast<int>(targets)))];
    const Vec3d within = random.direction() * (random.uniform(0, 0.9) * double{target.radius});
    const Vec3d from = random.direction();
    const Vec3d to = vec_cast<double>(target.center) + within;
    VisitingRay ray{bvh, spheres, to + from * distance, -from};
    ray.run();
    EXPECT_TRUE(ray.hits());
    sum.nodes += ray.visits.nodes;
    sum.leaves += ray.visits.leaves;
  }
  return {sum.nodes / count, sum.leaves / count};
}

}  // namespace boule::test
