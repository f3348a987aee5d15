#include "render/prepare/extreme_spheres.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/geometry/bvh_builder.h"

namespace boule {
namespace {

/// The sphere in a slot.
Sphere sphere_in(const Bvh& tree, std::size_t slot) {
  const SphereBlock& block = tree.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  return {{block.center_x[k], block.center_y[k], block.center_z[k]}, block.radius[k]};
}

/// Goes through a tree for one measure, where it is least first.
class Walk {
 public:
  Walk(const Bvh& tree, const SphereMeasure& measure) : tree_(tree), measure_(measure) {
    const BvhNode& root = tree.nodes[0];
    for (std::size_t k = 0; k < root.size; ++k) {
      const auto [low, high] = box_of(root, k);
      for (const Vec3d& corner : {low, high}) {
        scale_ = std::max({scale_, std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z)});
      }
    }
  }

  void collect(std::vector<Sphere>& spheres) {
    visit(0, [this](const Sphere& sphere) { least_ = std::min(least_, measure_.of(sphere)); });
    // Whoever computes the measure in another order rounds a few times more.
    margin_ = 0x1p-46 * scale_;
    visit(0, [&](const Sphere& sphere) {
      if (measure_.of(sphere) <= least_ + margin_) spheres.push_back(sphere);
    });
  }

 private:
  struct Box {
    Vec3d low, high;
  };
  struct Child {
    std::size_t index;
    double least;
  };

  static Box box_of(const BvhNode& node, std::size_t k) {
    return {{node.min_x[k], node.min_y[k], node.min_z[k]},
            {node.max_x[k], node.max_y[k], node.max_z[k]}};
  }

  template <class Take>
  void visit(std::size_t index, const Take& take) {
    const BvhNode& node = tree_.nodes[index];
    Child children[bvh_width];
    for (std::size_t k = 0; k < node.size; ++k) {
      const auto [low, high] = box_of(node, k);
      children[k] = {k, measure_.least_in(low, high)};
    }
    std::sort(children, children + node.size,
              [](const Child& a, const Child& b) { return a.least < b.least; });
    for (std::size_t i = 0; i < node.size; ++i) {
      const auto [k, least] = children[i];
      if (!(least <= least_ + margin_)) return;
      if (node.leaf_size[k] == 0) {
        visit(node.child[k], take);
        continue;
      }
      const std::size_t first =
          tree_.scanned + std::size_t{index_of(node.child[k])} * bvh_leaf_size;
      for (std::size_t slot = first; slot < first + node.leaf_size[k]; ++slot)
        take(sphere_in(tree_, slot));
    }
  }

  const Bvh& tree_;
  const SphereMeasure& measure_;
  double least_ = std::numeric_limits<double>::infinity();
  double scale_ = 0, margin_ = 0;
};

/// AxisExtremes has a sphere for which it is least: nobody rounds it otherwise.
bool is_known(const SphereMeasure& measure) {
  const auto& [x, y, z] = measure.direction;
  const auto is_one_or_none = [](double a, double b, double c) {
    return b == 0 && c == 0 && (a == 0 || std::fabs(a) == 1);
  };
  return is_one_or_none(x, y, z) || is_one_or_none(y, z, x) || is_one_or_none(z, x, y);
}

/// Those of one tree.
void add_extremes(const Bvh& tree, std::span<const SphereMeasure> measures,
                  std::vector<Sphere>& spheres) {
  for (std::size_t slot = 0; slot < tree.scanned; ++slot) {
    if (tree.slots[slot] >= 0) spheres.push_back(sphere_in(tree, slot));
  }
  if (tree.nodes.empty()) return;
  for (const SphereMeasure& measure : measures) {
    if (!is_known(measure)) Walk(tree, measure).collect(spheres);
  }
}

}  // namespace

double SphereMeasure::of(const Sphere& s) const {
  return dot(direction, vec_cast<double>(s.center)) - weight * static_cast<double>(s.radius);
}

double SphereMeasure::least_in(const Vec3d& low, const Vec3d& high) const {
  const auto& [x, y, z] = direction;
  return x * (x > 0 ? low.x : high.x) + y * (y > 0 ? low.y : high.y) + z * (z > 0 ? low.z : high.z);
}

std::vector<Sphere> extreme_spheres(const PackedSpheres& packed,
                                    std::span<const SphereMeasure> measures) {
  std::vector<Sphere> spheres = packed.extremes;
  for (const PackedTree& one : packed.trees) add_extremes(*one.tree, measures, spheres);
  return spheres;
}

}  // namespace boule
