#include "simd/geometry/binary_tree.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "simd/abi/bvh.h"
#include "simd/geometry/split.h"

namespace boule {
namespace {

/// Brings the kept_copies with the lowest ids to the front of the copies of one sphere.
void bring_first(std::span<BuildSphere> copies, std::span<const std::int32_t> ids) {
  const auto id_of = [ids](const BuildSphere& sphere) {
    return ids.empty() ? sphere.id : ids[static_cast<std::size_t>(sphere.id)];
  };
  const auto by_id = [&](const BuildSphere& a, const BuildSphere& b) {
    return id_of(a) < id_of(b);
  };
  std::partial_sort(copies.begin(), copies.begin() + kept_copies, copies.end(), by_id);
}

class Builder {
 public:
  Builder(std::span<BuildSphere> scratch, std::span<const std::int32_t> ids)
      : scratch_(scratch), ids_(ids) {
    tree_.nodes.reserve(2 * leaves_of(scratch.size()) + scratch.size() / 16);
  }

  BinaryTree build(std::span<BuildSphere> spheres, int depth) {
    tree_.costs = add(spheres, depth);
    return std::move(tree_);
  }

 private:
  /// Appends the tree over `spheres`.
  CollapseCosts add(std::span<BuildSphere> spheres, int depth) {
    const std::size_t index = tree_.nodes.size();
    tree_.nodes.emplace_back();
    if (spheres.size() <= bvh_leaf_size) {
      set_leaf(tree_.nodes[index], spheres);
      return {};
    }
    const bool deep = depth + halving_levels(spheres.size()) > bvh_max_depth;
    const std::size_t middle = deep ? halve(spheres, extent_of(spheres)) : split(spheres, scratch_);
    if (middle == 0) {
      bring_first(spheres, ids_);
      set_leaf(tree_.nodes[index], spheres.first(kept_copies));
      tree_.nodes[index].set_copies(spheres.size() - kept_copies);
      return {};
    }
    const CollapseCosts left = add(spheres.first(middle), depth + 1);
    const auto second = static_cast<std::uint32_t>(tree_.nodes.size());
    const CollapseCosts right = add(spheres.subspan(middle), depth + 1);
    BinaryNode& node = tree_.nodes[index];
    node.right = second;
    BuildBox box = tree_.nodes[index + 1].box();
    box.add(tree_.nodes[second].box());
    node.set_box(box);
    return choose_shares(node, left, right);
  }

  void set_leaf(BinaryNode& node, std::span<const BuildSphere> spheres) {
    BuildBox box;
    for (const BuildSphere& sphere : spheres) box.add(outward_box(sphere));
    node.set_box(box);
    node.right = tree_.leaves++;
    node.size = static_cast<std::uint32_t>(spheres.size());
  }

  BinaryTree tree_;
  std::span<BuildSphere> scratch_;
  std::span<const std::int32_t> ids_;
};

}  // namespace

CollapseCosts choose_shares(BinaryNode& node, const CollapseCosts& left,
                            const CollapseCosts& right) {
  CollapseCosts costs;
  for (std::size_t j = 2; j < costs.size(); ++j) {
    costs[j] = left[1] + right[j - 1];
    std::size_t share = 1;
    for (std::size_t k = 2; k < j; ++k) {
      const double both = left[k] + right[j - k];
      if (both < costs[j]) {
        costs[j] = both;
        share = k;
      }
    }
    node.set_share(static_cast<int>(j), static_cast<int>(share));
  }
  costs[0] = 0;
  costs[1] = node.box().area() + costs.back();
  return costs;
}

int halving_levels(std::size_t spheres) {
  return static_cast<int>(std::bit_width(leaves_of(spheres) - 1));
}

BinaryTree build_binary_tree(std::span<BuildSphere> spheres, std::span<BuildSphere> scratch,
                             int depth, std::span<const std::int32_t> ids) {
  return Builder(scratch, ids).build(spheres, depth);
}

}  // namespace boule
