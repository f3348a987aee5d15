#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/scenes/bench_scenes.h"
#include "core/math/ray.h"

namespace boule::bench {

/// The truth that every contender is compared with: the reference's solves, one ray at a time, over
/// a plain binary tree of boxes in double. It shares no code with the kernels. Boxes are grown by
/// 1e-9 of the scene's size, far more than any rounding in double, so no hit is lost and the
/// answers are those of brute force.
class DoubleTree {
 public:
  /// `scene` must outlive the tree, unchanged; finite numbers.
  explicit DoubleTree(const BenchScene& scene);

  /// As reference::closest_hit and any_hit.
  [[nodiscard]] Hit closest_hit(const Ray& ray) const;
  [[nodiscard]] bool any_hit(const Ray& ray) const;

  /// Calls visit(id) for every primitive whose box the ray enters, and for a few others. All
  /// that the ray hits are among them.
  void for_each_candidate(const Ray& ray, const std::function<void(std::int32_t)>& visit) const;

 private:
  struct Node {
    double min[3], max[3];
    std::uint32_t first;  ///< of a leaf: its first place in order_; else the first of two children
    std::uint32_t count;  ///< primitives of a leaf; 0: an inner node
  };

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  void set_box(Node& node, std::uint32_t first, std::uint32_t count) const;
  template <class Visit>
  void traverse(const Ray& ray, const double& limit, const Visit& visit) const;

  const BenchScene& scene_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
  double margin_ = 0;
};

}  // namespace boule::bench
