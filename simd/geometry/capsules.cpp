#include "simd/geometry/capsules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "simd/geometry/build_box.h"
#include "simd/geometry/bvh_builder.h"
#include "simd/geometry/node_boxes.h"

namespace boule {
namespace {

/// A sphere around a capsule, by which the tree is divided. It is rounded, and need not hold all of
/// the capsule.
Sphere sphere_around(const Capsule& capsule) {
  const Vec3d a = vec_cast<double>(capsule.a), b = vec_cast<double>(capsule.b);
  const Vec3d half = (b - a) * 0.5;
  const double radius = std::sqrt(dot(half, half)) + std::fabs(double{capsule.radius});
  return {vec_cast<float>(a + half), static_cast<float>(radius), {}};
}

/// The capsules' ids, from 0 on, in the order of their slots; and the tree, whose boxes are those
/// of spheres.
struct Order {
  std::vector<std::int32_t> scanned{};
  Bvh tree;
};

Order order_of(const std::vector<Capsule>& capsules, const ParallelFor& parallel_for) {
  Order order;
  std::vector<Sphere> spheres;
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    const auto id = static_cast<std::int32_t>(i);
    const Sphere sphere = sphere_around(capsules[i]);
    if (!in_filter_range(sphere)) {
      order.scanned.push_back(id);
      continue;
    }
    spheres.push_back(sphere);
    ids.push_back(id);
  }
  // The kernels make a leaf one more level of nodes, for which depth 2 leaves room.
  order.tree = build_bvh(std::move(spheres), parallel_for, {.depth = 2, .keeps_apart = false});
  for (std::int32_t& slot : order.tree.slots) {
    if (slot >= 0) slot = ids[static_cast<std::size_t>(slot)];
  }
  // Different capsules may have one sphere around them, of which a tree keeps only two.
  for (const SphereCopy& copy : order.tree.copies)
    order.scanned.push_back(ids[static_cast<std::size_t>(copy.id)]);
  return order;
}

constexpr std::size_t blocks_for(std::size_t slots) {
  return (slots + bvh_leaf_size - 1) / bvh_leaf_size;
}

CapsuleBlock no_capsules() {
  CapsuleBlock block{};
  std::fill_n(block.radius, bvh_leaf_size, std::numeric_limits<float>::quiet_NaN());
  return block;
}

void set_capsule(CapsuleBlock& block, std::size_t k, const Capsule& capsule) {
  block.a_x[k] = capsule.a.x;
  block.a_y[k] = capsule.a.y;
  block.a_z[k] = capsule.a.z;
  block.b_x[k] = capsule.b.x;
  block.b_y[k] = capsule.b.y;
  block.b_z[k] = capsule.b.z;
  block.radius[k] = capsule.radius;
}

Capsule get_capsule(const CapsuleBlock& block, std::size_t k) {
  return {{block.a_x[k], block.a_y[k], block.a_z[k]},
          {block.b_x[k], block.b_y[k], block.b_z[k]},
          block.radius[k],
          {}};
}

/// The boxes of the spheres at both ends hold the capsule.
BuildBox box_of(const Capsule& capsule) {
  const auto& [a, b, radius, material] = capsule;
  BuildBox box = outward_box({{a.x, a.y, a.z, radius}, 0});
  box.add(outward_box({{b.x, b.y, b.z, radius}, 0}));
  return box;
}

BuildBox box_of(const BvhNode& node) {
  BuildBox box;
  for (std::size_t k = 0; k < node.size; ++k) box.add(child_box(node, k));
  return box;
}

/// Replaces the boxes of spheres by those of the capsules. `leaves`: the block of leaf 0. A node's
/// children follow it.
void refit(LargeArray<BvhNode>& nodes, const CapsuleBlock* leaves) {
  for (std::size_t i = nodes.size(); i-- > 0;) {
    BvhNode& node = nodes[i];
    for (std::size_t k = 0; k < node.size; ++k) {
      const std::uint32_t child = node.child[k];
      BuildBox box;
      if ((child & leaf_bit) == 0) box = box_of(nodes[child]);
      for (std::size_t j = 0; j < node.leaf_size[k]; ++j)
        box.add(box_of(get_capsule(leaves[index_of(child)], j)));
      set_child_box(node, k, box);
    }
  }
}

}  // namespace

CapsuleTree::CapsuleTree(const std::vector<Capsule>& capsules, std::int32_t first_id,
                         const ParallelFor& parallel_for)
    : size_(capsules.size()), first_id_(first_id) {
  Order order = order_of(capsules, parallel_for);
  const std::size_t apart = blocks_for(order.scanned.size());
  scanned_ = apart * bvh_leaf_size;
  blocks_.resize(apart + order.tree.blocks.size());
  ids_.resize(blocks_.size() * bvh_leaf_size);
  std::fill(blocks_.begin(), blocks_.end(), no_capsules());
  std::fill(ids_.begin(), ids_.end(), empty_slot);
  const auto put = [&](std::size_t slot, std::int32_t id) {
    set_capsule(blocks_[slot / bvh_leaf_size], slot % bvh_leaf_size,
                capsules[static_cast<std::size_t>(id)]);
    ids_[slot] = first_id + id;
  };
  for (std::size_t i = 0; i < order.scanned.size(); ++i) put(i, order.scanned[i]);
  for (std::size_t i = 0; i < order.tree.slots.size(); ++i) {
    if (order.tree.slots[i] >= 0) put(scanned_ + i, order.tree.slots[i]);
  }
  nodes_ = std::move(order.tree.nodes);
  refit(nodes_, blocks_.data() + apart);
  if (nodes_.empty()) return;
  const BuildBox all = box_of(nodes_[0]);
  for (int k = 0; k < 3; ++k)
    extent_ = std::max({extent_, std::fabs(all.low[k]), std::fabs(all.high[k])});
}

CapsuleView CapsuleTree::view() const {
  return {.blocks = blocks_.data(),
          .id = ids_.data(),
          .scanned = scanned_,
          .slots = ids_.size(),
          .bvh = {nodes_.data(), nodes_.size(), extent_},
          .first_id = first_id_};
}

Capsule CapsuleTree::capsule(std::uint32_t slot) const {
  return get_capsule(blocks_[slot / bvh_leaf_size], slot % bvh_leaf_size);
}

}  // namespace boule
