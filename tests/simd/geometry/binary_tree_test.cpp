#include "simd/geometry/binary_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/abi/bvh.h"
#include "simd/geometry/bvh_builder.h"
#include "tests/support/case_random.h"

namespace boule::test {
namespace {

BuildSphere random_sphere(CaseRandom& random, std::int32_t id) {
  const auto x = static_cast<float>(random.uniform());
  const auto y = static_cast<float>(random.uniform());
  const auto z = static_cast<float>(random.uniform());
  return {{x, y, z, static_cast<float>(random.uniform(0.001, 0.2))}, id};
}

std::vector<BuildSphere> cloud(std::uint64_t seed, int count) {
  CaseRandom random(seed);
  std::vector<BuildSphere> spheres;
  for (int i = 0; i < count; ++i) spheres.push_back(random_sphere(random, i));
  return spheres;
}

BinaryTree build(std::vector<BuildSphere>& spheres, int depth = 1) {
  std::vector<BuildSphere> scratch(spheres.size());
  return build_binary_tree(spheres, scratch, depth);
}

/// Inner nodes on the longest way down from `node`.
int depth_below(const BinaryTree& tree, std::uint32_t node) {
  if (tree.nodes[node].size > 0) return 0;
  return 1 + std::max(depth_below(tree, node + 1), depth_below(tree, tree.nodes[node].right));
}

TEST(BuildBox, HoldsItsSphereDespiteRounding) {
  CaseRandom random(61);
  for (int i = 0; i < 200'000; ++i) {
    const auto center = static_cast<float>(random.sign() * random.decade(-44, 18));
    const auto radius = static_cast<float>(
        i % 3 == 0 ? std::fabs(double{center}) * random.decade(-8, 1) : random.decade(-44, 17.9));
    const BuildBox box = outward_box({{center, -center, radius, radius}, 0});
    const double r = double{radius} * (1 + 0x1p-22);
    const double c[3] = {double{center}, -double{center}, double{radius}};
    for (int k = 0; k < 3; ++k) {
      // A float step and more: the next float inward is still outside. Below 2^-126 half a step of
      // 2^-149 may be lost.
      const float low = std::nextafter(box.low[k], BuildBox::inf);
      const float high = std::nextafter(box.high[k], -BuildBox::inf);
      const auto lost = [](double x) { return std::fabs(x) < 0x1p-126 ? 0x1.8p-149 : 0; };
      ASSERT_LE(double{low}, c[k] - r + lost(c[k] - r)) << center << " " << radius;
      ASSERT_GE(double{high}, c[k] + r - lost(c[k] + r)) << center << " " << radius;
      ASSERT_GE(double{box.low[k]}, c[k] - r - (std::fabs(c[k]) + r) * 0x1p-20 - 0x1p-149);
      ASSERT_LE(double{box.high[k]}, c[k] + r + (std::fabs(c[k]) + r) * 0x1p-20 + 0x1p-149);
    }
  }
}

TEST(BinaryTree, LeavesHoldEverySphereInOrder) {
  auto spheres = cloud(62, 1000);
  const BinaryTree tree = build(spheres);
  std::uint32_t leaves = 0, held = 0;
  for (const BinaryNode& node : tree.nodes) {
    if (node.size == 0) continue;
    EXPECT_EQ(node.right, leaves++);
    held += node.size;
  }
  EXPECT_EQ(leaves, tree.leaves);
  EXPECT_EQ(held, 1000U);
  std::sort(spheres.begin(), spheres.end(), [](auto& a, auto& b) { return a.id < b.id; });
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(spheres[static_cast<std::size_t>(i)].id, i);
}

/// 38 spheres, each 17 times as far as the one before, and 20,000 in the middle: splits peel off
/// one after the other, and what remains would be too much for the levels that remain.
TEST(BinaryTree, IsNoDeeperThanTheKernelsStack) {
  std::vector<BuildSphere> spheres;
  for (int i = 0; i < 38; ++i) {
    const auto far = static_cast<float>(elementary::pow(17, i) * 1e-29);
    spheres.push_back({{far, 0, 0, 0.01F * far}, i});
  }
  for (int i = 38; i < 20'038; ++i) {
    const double radius = 1e-33 * (1 + 1e-6 * i);  // no copies, which would be left out
    spheres.push_back({{0, 0, 0, static_cast<float>(radius)}, i});
  }
  for (const int depth : {1, 20, 30}) {
    auto run = spheres;
    const BinaryTree tree = build(run, depth);
    EXPECT_EQ(depth - 1 + depth_below(tree, 0), bvh_max_depth);
    EXPECT_LT(tree.leaves, 20'038U / 7);
  }
}

/// The costs of all ways to put the nodes below a binary one into a wide one, by trying every set.
struct EverySet {
  const BinaryTree& tree;

  [[nodiscard]] std::uint32_t right(std::uint32_t node) const { return tree.nodes[node].right; }
  [[nodiscard]] bool is_leaf(std::uint32_t node) const { return tree.nodes[node].size > 0; }

  /// The least cost of a wide node made of `node`.
  [[nodiscard]] double least(std::uint32_t node) const {
    if (is_leaf(node)) return 0;
    double best = std::numeric_limits<double>::infinity();
    try_all({node + 1, right(node)}, 0, best);
    return best + tree.nodes[node].box().area();
  }
  /// Divides any of `children` from index `first` on.
  void try_all(const std::vector<std::uint32_t>& children, std::size_t first, double& best) const {
    double cost = 0;
    for (const std::uint32_t node : children) cost += least(node);
    best = std::min(best, cost);
    if (children.size() == static_cast<std::size_t>(bvh_width)) return;
    for (std::size_t k = first; k < children.size(); ++k) {
      if (is_leaf(children[k])) continue;
      auto more = children;
      more[k] = children[k] + 1;
      more.insert(more.begin() + static_cast<std::ptrdiff_t>(k) + 1, right(children[k]));
      try_all(more, k, best);
    }
  }
};

double area_of(const BvhNode& node, std::size_t k) {
  return BuildBox{{node.min_x[k], node.min_y[k], node.min_z[k], 0},
                  {node.max_x[k], node.max_y[k], node.max_z[k], 0}}
      .area();
}

/// Sums come in another order: compared to 1e-12.
TEST(Collapse, CostsAsLittleAsPossible) {
  for (std::uint64_t seed = 70; seed < 90; ++seed) {
    auto spheres = cloud(seed, 60 + 4 * static_cast<int>(seed - 70));
    const BinaryTree tree = build(spheres);
    const double best = EverySet{tree}.least(0);
    EXPECT_NEAR(tree.costs[1], best, 1e-12 * best);

    std::vector<Sphere> same;
    for (const BuildSphere& s : cloud(seed, static_cast<int>(spheres.size())))
      same.push_back({{s.at[0], s.at[1], s.at[2]}, s.at[3], 0});
    const Bvh bvh = build_bvh(same);
    if (bvh.scanned > 0) continue;  // another tree
    double sum = tree.nodes[0].box().area();
    for (const BvhNode& node : bvh.nodes) {
      for (std::size_t k = 0; k < node.size; ++k)
        sum += node.leaf_size[k] > 0 ? 0 : area_of(node, k);
    }
    EXPECT_NEAR(sum, best, 1e-12 * best);
  }
}

}  // namespace
}  // namespace boule::test
