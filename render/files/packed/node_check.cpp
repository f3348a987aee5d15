#include "render/files/packed/node_check.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "simd/abi/filter_bounds.h"

namespace boule {
namespace {

constexpr std::uint32_t no_node = ~std::uint32_t{0};

/// The parents of all nodes: threads enter each at most once.
class Parents {
 public:
  explicit Parents(std::size_t nodes)
      : of_(std::make_unique_for_overwrite<std::atomic<std::uint32_t>[]>(nodes)) {
    for (std::size_t i = 0; i < nodes; ++i) of_[i].store(no_node, std::memory_order_relaxed);
  }
  /// False if the node has a parent already.
  bool enter(std::uint32_t node, std::uint32_t parent) {
    return of_[node].exchange(parent, std::memory_order_relaxed) == no_node;
  }
  [[nodiscard]] std::uint32_t operator[](std::size_t node) const {
    return of_[node].load(std::memory_order_relaxed);
  }

 private:
  std::unique_ptr<std::atomic<std::uint32_t>[]> of_;
};

bool is_sound(float low, float high) {
  // Filters judge boxes of spheres within their limit: twice that bounds a box with its margin.
  constexpr float most = 2 * filter::limit;
  return low >= -most && high <= most && low <= high;
}

bool has_sound_boxes(const BvhNode& node) {
  bool sound = true;
  for (std::size_t k = 0; k < node.size; ++k) {
    sound = sound && is_sound(node.min_x[k], node.max_x[k]) &&
            is_sound(node.min_y[k], node.max_y[k]) && is_sound(node.min_z[k], node.max_z[k]);
  }
  for (std::size_t k = node.size; k < bvh_width; ++k) {
    // Empty boxes, which no ray meets.
    const bool empty = node.min_x[k] > node.max_x[k] && node.min_y[k] > node.max_y[k] &&
                       node.min_z[k] > node.max_z[k];
    sound = sound && empty;
  }
  return sound;
}

/// What is wrong with the children of one node; null: nothing.
const char* find_problem(const BvhNode& node, std::uint32_t index, std::size_t nodes,
                         std::uint64_t leaves, Parents& parents) {
  if (node.size > bvh_width) return "has too many children";
  if (!has_sound_boxes(node)) return "has a box that is none";
  for (std::size_t k = 0; k < node.size; ++k) {
    const std::uint32_t child = node.child[k];
    if ((child & leaf_bit) != 0) {
      if (index_of(child) >= leaves) return "leads to a leaf that is not there";
      if (node.leaf_size[k] < 1 || node.leaf_size[k] > bvh_leaf_size)
        return "has a leaf of a wrong size";
    } else {
      if (node.leaf_size[k] != 0) return "has a node with the size of a leaf";
      if (child <= index || child >= nodes) return "leads to a node that is not behind it";
      if (!parents.enter(child, index)) return "leads to a node that has another parent";
    }
  }
  return nullptr;
}

Diagnostic about(std::size_t node, const char* what) {
  return Diagnostic::of("it is damaged: node " + std::to_string(node) + " " + what);
}

}  // namespace

Status check_nodes(std::span<const BvhNode> nodes, std::uint64_t leaves,
                   const ParallelFor& parallel_for) {
  if (nodes.empty()) return {};
  if (nodes.size() > leaf_bit) return Diagnostic::of("it has too many nodes");
  Parents parents(nodes.size());
  constexpr std::size_t at_once = 2048;
  struct Found {
    std::size_t node = 0;
    const char* what = nullptr;
  };
  std::vector<Found> found((nodes.size() + at_once - 1) / at_once);
  parallel_for(found.size(), [&](std::size_t piece) {
    const std::size_t first = piece * at_once, end = std::min(first + at_once, nodes.size());
    for (std::size_t i = first; i < end && found[piece].what == nullptr; ++i) {
      found[piece] = {
          i, find_problem(nodes[i], static_cast<std::uint32_t>(i), nodes.size(), leaves, parents)};
    }
  });
  for (const Found& one : found) {
    if (one.what != nullptr) return about(one.node, one.what);
  }
  std::vector<std::uint8_t> depth(nodes.size(), 1);  // parents come before their children
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (parents[i] == no_node) continue;
    depth[i] = static_cast<std::uint8_t>(depth[parents[i]] + 1);
    if (depth[i] > bvh_max_depth) return about(i, "lies too deep");
  }
  return {};
}

}  // namespace boule
