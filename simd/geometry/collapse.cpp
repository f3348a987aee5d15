#include "simd/geometry/collapse.h"

#include <algorithm>
#include <utility>

namespace boule {
namespace {

BvhNode empty_node() {
  BvhNode node{};
  for (float* row : {node.min_x, node.min_y, node.min_z})
    std::fill_n(row, bvh_width, BuildBox::inf);
  for (float* row : {node.max_x, node.max_y, node.max_z})
    std::fill_n(row, bvh_width, -BuildBox::inf);
  return node;
}

void set_box(BvhNode& node, std::size_t k, const BuildBox& box) {
  node.min_x[k] = box.low[0];
  node.min_y[k] = box.low[1];
  node.min_z[k] = box.low[2];
  node.max_x[k] = box.high[0];
  node.max_y[k] = box.high[1];
  node.max_z[k] = box.high[2];
}

class Collapse {
 public:
  explicit Collapse(const BinaryForest& forest) : forest_(forest) { add(forest.root()); }

  [[nodiscard]] std::vector<BvhNode> nodes() && { return std::move(nodes_); }

 private:
  struct Children {
    ForestNode nodes[bvh_width];
    std::size_t size = 0;
  };

  /// Appends the wide node of a binary one and all below it.
  void add(ForestNode root) {
    Children children;
    collect(root, bvh_width, children);
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    BvhNode node = empty_node();
    node.size = static_cast<std::uint8_t>(children.size);
    for (std::size_t k = 0; k < children.size; ++k) {
      const ForestNode at = children.nodes[k];
      const BinaryNode& child = forest_[at];
      set_box(node, k, child.box);
      node.leaf_size[k] = static_cast<std::uint8_t>(child.size);
      if (child.size > 0) {
        node.child[k] = (forest_.subtrees()[at.tree].first_leaf + child.right) | leaf_bit;
      } else {
        node.child[k] = static_cast<std::uint32_t>(nodes_.size());
        add(at);
      }
    }
    nodes_[index] = node;
  }

  /// Collects the binary nodes that stand for one in `most` children of a wide node.
  void collect(ForestNode at, int most, Children& children) const {
    const BinaryNode& node = forest_[at];
    const int left = node.size > 0 ? 0 : node.share[most];
    if (left == 0) {
      children.nodes[children.size++] = at;
    } else {
      collect(forest_.left(at), left, children);
      collect(forest_.right(at), most - left, children);
    }
  }

  const BinaryForest& forest_;
  std::vector<BvhNode> nodes_;
};

}  // namespace

std::vector<BvhNode> collapse(const BinaryForest& forest) { return Collapse(forest).nodes(); }

}  // namespace boule
