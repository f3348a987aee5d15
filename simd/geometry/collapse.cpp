#include "simd/geometry/collapse.h"

#include <algorithm>

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

struct Children {
  ForestNode nodes[bvh_width];
  std::size_t size = 0;
};

/// Collects the binary nodes that stand for one in `most` children of a wide node.
void collect(const BinaryForest& forest, ForestNode at, int most, Children& children) {
  const BinaryNode& node = forest[at];
  const int left = node.size > 0 ? 0 : node.share(most);
  if (left == 0) {
    children.nodes[children.size++] = at;
  } else {
    collect(forest, forest.left(at), left, children);
    collect(forest, forest.right(at), most - left, children);
  }
}

Children children_of(const BinaryForest& forest, ForestNode at) {
  Children children;
  collect(forest, at, bvh_width, children);
  return children;
}

/// How many wide nodes one within a subtree and those below it are.
std::size_t count_nodes(const BinaryForest& forest, ForestNode at) {
  const Children children = children_of(forest, at);
  std::size_t count = 1;
  for (std::size_t k = 0; k < children.size; ++k) {
    if (forest[children.nodes[k]].size == 0) count += count_nodes(forest, children.nodes[k]);
  }
  return count;
}

/// Makes a wide node; make(child) makes those below that are no leaves, one after the other, and
/// returns their indices.
template <class Make>
BvhNode make_node(const BinaryForest& forest, ForestNode root, const Make& make) {
  const Children children = children_of(forest, root);
  BvhNode node = empty_node();
  node.size = static_cast<std::uint8_t>(children.size);
  for (std::size_t k = 0; k < children.size; ++k) {
    const ForestNode at = children.nodes[k];
    const BinaryNode& child = forest[at];
    set_box(node, k, child.box());
    node.leaf_size[k] = static_cast<std::uint8_t>(child.size);
    node.child[k] = child.size > 0
                        ? (forest.subtrees()[at.tree].first_leaf + child.right) | leaf_bit
                        : static_cast<std::uint32_t>(make(at));
  }
  return node;
}

/// Makes the wide node of one within a subtree, and all below it, from index `next` on.
std::size_t make_below(const BinaryForest& forest, ForestNode at, std::size_t& next,
                       BvhNode* nodes) {
  const std::size_t index = next++;
  nodes[index] = make_node(
      forest, at, [&](ForestNode child) { return make_below(forest, child, next, nodes); });
  return index;
}

}  // namespace

Collapse::Collapse(const BinaryForest& forest, const ParallelFor& parallel_for)
    : forest_(forest), of_subtrees_(forest.subtrees().size()) {
  plan(forest.root());
  parallel_for(parts_.size(), [this](std::size_t i) {
    if (parts_[i].at.tree != ForestNode::upper)
      parts_[i].count = count_nodes(forest_, parts_[i].at);
  });
  for (Part& part : parts_) {
    part.first = size_;
    size_ += part.count;
  }
}

/// Lists the parts at and below a node that becomes a wide one.
void Collapse::plan(ForestNode at) {
  parts_.push_back({at});
  if (at.tree != ForestNode::upper) {
    Parts& parts = of_subtrees_[at.tree];
    if (parts.end == 0) parts.begin = parts_.size() - 1;
    parts.end = parts_.size();
    return;
  }
  const Children children = children_of(forest_, at);
  for (std::size_t k = 0; k < children.size; ++k) {
    if (forest_[children.nodes[k]].size == 0) plan(children.nodes[k]);
  }
}

std::vector<Collapse::PlacedNode> Collapse::make_upper() const {
  std::vector<PlacedNode> nodes;
  std::size_t part = 0;
  make_upper(forest_.root(), part, nodes);
  return nodes;
}

/// Goes through the parts in the order of their plan.
void Collapse::make_upper(ForestNode at, std::size_t& part, std::vector<PlacedNode>& nodes) const {
  const std::size_t index = parts_[part++].first;
  if (at.tree != ForestNode::upper) return;
  const auto make = [&](ForestNode child) {
    const std::size_t first = parts_[part].first;
    make_upper(child, part, nodes);
    return first;
  };
  nodes.push_back({index, make_node(forest_, at, make)});
}

void Collapse::make_subtree(std::uint32_t subtree, BvhNode* nodes) const {
  const Parts& own = of_subtrees_[subtree];
  for (std::size_t i = own.begin; i < own.end; ++i) {
    std::size_t next = parts_[i].first;
    make_below(forest_, parts_[i].at, next, nodes);
  }
}

}  // namespace boule
