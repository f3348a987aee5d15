#include "simd/geometry/collapse.h"

#include "simd/geometry/node_boxes.h"

namespace boule {
namespace {

/// A subtree, whose nodes are identified by their index.
struct TreePart {
  using Node = std::uint32_t;
  const BinaryTree& tree;

  [[nodiscard]] const BinaryNode& operator[](Node node) const { return tree.nodes[node]; }
  [[nodiscard]] int share(Node node, int most) const {
    return tree.nodes[node].size > 0 ? 0 : tree.nodes[node].share(most);
  }
  [[nodiscard]] static Node left(Node node) { return node + 1; }
  [[nodiscard]] Node right(Node node) const { return tree.nodes[node].right; }
};

/// The upper part, in which a subtree larger than a twig is always one child.
struct ForestPart {
  using Node = ForestNode;
  const BinaryForest& forest;

  [[nodiscard]] const BinaryNode& operator[](Node node) const { return forest[node]; }
  [[nodiscard]] int share(Node node, int most) const {
    return forest.is_open(node) ? forest[node].share(most) : 0;
  }
  [[nodiscard]] Node left(Node node) const { return forest.left(node); }
  [[nodiscard]] Node right(Node node) const { return forest.right(node); }
};

template <class Part>
struct Children {
  typename Part::Node nodes[bvh_width];
  std::size_t size = 0;
};

/// Collects the binary nodes that become the children, at most `most`, of a wide node.
template <class Part>
void collect(const Part& part, typename Part::Node at, int most, Children<Part>& children) {
  const int left = part.share(at, most);
  if (left == 0) {
    children.nodes[children.size++] = at;
  } else {
    collect(part, part.left(at), left, children);
    collect(part, part.right(at), most - left, children);
  }
}

template <class Part>
Children<Part> children_of(const Part& part, typename Part::Node at) {
  Children<Part> children;
  collect(part, at, bvh_width, children);
  return children;
}

/// The number of wide nodes in one node of a subtree and below it.
std::size_t count_below(const TreePart& part, std::uint32_t at) {
  const auto children = children_of(part, at);
  std::size_t count = 1;
  for (std::size_t k = 0; k < children.size; ++k) {
    if (part[children.nodes[k]].size == 0) count += count_below(part, children.nodes[k]);
  }
  return count;
}

/// Makes a wide node. leaf(child) is the index of a leaf; inner(child) makes the inner nodes below,
/// one after the other, and returns their indices.
template <class Part, class Leaf, class Inner>
BvhNode make_node(const Part& part, typename Part::Node root, const Leaf& leaf,
                  const Inner& inner) {
  const auto children = children_of(part, root);
  BvhNode node = empty_node();
  node.size = static_cast<std::uint8_t>(children.size);
  for (std::size_t k = 0; k < children.size; ++k) {
    const auto at = children.nodes[k];
    const BinaryNode& child = part[at];
    set_child_box(node, k, child.box());
    node.leaf_size[k] = static_cast<std::uint8_t>(child.size);
    node.child[k] = child.size > 0 ? static_cast<std::uint32_t>(leaf(at)) | leaf_bit
                                   : static_cast<std::uint32_t>(inner(at));
  }
  return node;
}

/// The place of a subtree's nodes and leaves.
struct Target {
  BvhNode* nodes;
  std::size_t next, first_leaf;
};

/// Makes the wide node of a node within a subtree, and all nodes below it.
std::size_t make_below(const TreePart& part, std::uint32_t at, Target& target) {
  const std::size_t index = target.next++;
  target.nodes[index] = make_node(
      part, at, [&](std::uint32_t child) { return target.first_leaf + part[child].right; },
      [&](std::uint32_t child) { return make_below(part, child, target); });
  return index;
}

}  // namespace

Collapse::Collapse(const BinaryForest& forest) : forest_(forest) {
  std::uint32_t next_subtree = 0;
  if (forest.root().is_upper()) plan(forest.root(), next_subtree);
}

/// Lists the nodes of the upper part, at and below this one, that become wide nodes.
void Collapse::plan(ForestNode at, std::uint32_t& next_subtree) {
  upper_.push_back({at, next_subtree});
  const auto children = children_of(ForestPart{forest_}, at);
  for (std::size_t k = 0; k < children.size; ++k) {
    const ForestNode child = children.nodes[k];
    forest_.is_open(child) ? plan(child, next_subtree) : void(next_subtree = child.tree + 1);
  }
}

/// Gives the upper nodes just before a subtree their places.
void Collapse::place_upper(std::size_t next_subtree) {
  while (upper_places_.size() < upper_.size() &&
         upper_[upper_places_.size()].next_subtree <= next_subtree) {
    upper_places_.push_back(node_count_++);
  }
}

std::size_t Collapse::count_nodes(std::size_t subtree) const {
  const BinaryTree& tree = forest_.subtrees()[subtree].tree;
  return tree.nodes[0].size > 0 || forest_.is_twig(subtree) ? 0 : count_below({tree}, 0);
}

void Collapse::place_next(std::size_t nodes, std::size_t leaves) {
  if (nodes == 0 && !forest_.root().is_upper()) upper_.push_back({forest_.root(), 0});
  place_upper(places_.size());
  places_.push_back({node_count_, leaf_count_});
  node_count_ += nodes;
  leaf_count_ += leaves;
  if (places_.size() == forest_.subtrees().size()) place_upper(places_.size());
}

void Collapse::make_subtree(std::size_t subtree, BvhNode* nodes) const {
  const BinaryTree& tree = forest_.subtrees()[subtree].tree;
  if (tree.nodes[0].size > 0 || forest_.is_twig(subtree)) return;
  Target target{nodes, places_[subtree].first_node, places_[subtree].first_leaf};
  make_below({tree}, 0, target);
}

void Collapse::make_upper(BvhNode* nodes) const {
  for (std::size_t i = 0; i < upper_.size(); ++i) {
    std::size_t next = i + 1;
    const auto leaf = [&](ForestNode child) {
      return places_[child.tree].first_leaf + forest_[child].right;
    };
    const auto inner = [&](ForestNode child) {
      if (!forest_.is_open(child)) return places_[child.tree].first_node;
      while (upper_[next].at != child) ++next;
      return upper_places_[next];
    };
    nodes[upper_places_[i]] = make_node(ForestPart{forest_}, upper_[i].at, leaf, inner);
  }
}

}  // namespace boule
