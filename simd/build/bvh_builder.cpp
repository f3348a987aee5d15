#include "simd/build/bvh_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "simd/abi/isa.h"
#include "simd/build/binary_forest.h"
#include "simd/build/filter_range.h"

namespace boule {
namespace {

/// Spheres that one thread reads at a time.
constexpr std::size_t chunk_size = 16'384;

BuildSphere build_sphere(const Sphere& s, std::int32_t id) {
  return {{s.center.x, s.center.y, s.center.z, std::fabs(s.radius)}, id};
}

/// Calls body(chunk, first, end) for all chunks of `count` things.
void for_chunks(const ParallelFor& parallel_for, std::size_t count, const auto& body) {
  parallel_for((count + chunk_size - 1) / chunk_size, [&](std::size_t chunk) {
    body(chunk, chunk * chunk_size, std::min((chunk + 1) * chunk_size, count));
  });
}

/// The box of all spheres that have one.
BuildBox box_of_all(const std::vector<Sphere>& spheres, const ParallelFor& parallel_for) {
  std::vector<BuildBox> boxes(spheres.size() / chunk_size + 1);
  for_chunks(parallel_for, spheres.size(), [&](auto chunk, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      if (in_filter_range(spheres[i])) boxes[chunk].add(rough_box(build_sphere(spheres[i], 0)));
    }
  });
  BuildBox all;
  for (const BuildBox& box : boxes) all.add(box);
  return all;
}

/// The spheres that no tree should hold, in order: those that fit no box, and the first few giants.
std::vector<std::int32_t> find_apart(const std::vector<Sphere>& spheres,
                                     const ParallelFor& parallel_for) {
  constexpr std::size_t most = 16;
  const double giant_area = 0.25 * box_of_all(spheres, parallel_for).area();
  const auto is_giant = [&](const Sphere& s) {
    return rough_box(build_sphere(s, 0)).area() > giant_area;
  };
  std::vector<std::vector<std::int32_t>> found(spheres.size() / chunk_size + 1);
  for_chunks(parallel_for, spheres.size(), [&](auto chunk, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      if (!in_filter_range(spheres[i]) || is_giant(spheres[i]))
        found[chunk].push_back(static_cast<std::int32_t>(i));
    }
  });
  std::vector<std::int32_t> apart;
  std::size_t giants = 0;
  for (const auto& some : found) {
    for (const std::int32_t id : some) {
      const bool giant = in_filter_range(spheres[static_cast<std::size_t>(id)]);
      if (!giant || giants < most) apart.push_back(id);
      giants += giant ? 1 : 0;
    }
  }
  return apart;
}

/// Copies all other spheres.
void gather(const std::vector<Sphere>& spheres, const std::vector<std::int32_t>& apart,
            const SphereBuffers& buffers, const ParallelFor& parallel_for) {
  for_chunks(parallel_for, spheres.size(), [&](auto, std::size_t first, std::size_t end) {
    auto next = std::lower_bound(apart.begin(), apart.end(), static_cast<std::int32_t>(first));
    const auto skipped = static_cast<std::size_t>(next - apart.begin());
    BuildSphere* target = buffers.arrays[0].get() + (first - skipped);
    for (std::size_t i = first; i < end; ++i) {
      const auto id = static_cast<std::int32_t>(i);
      if (next != apart.end() && *next == id) {
        ++next;
      } else {
        *target++ = build_sphere(spheres[i], id);
      }
    }
  });
}

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

/// Makes wide nodes of a binary tree.
class Collapse {
 public:
  Collapse(const BinaryForest& forest, std::vector<BvhNode>& nodes)
      : forest_(forest), nodes_(nodes) {}

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
        node.child[k] = forest_.subtrees()[at.tree].first_leaf + child.right;
      } else {
        node.child[k] = static_cast<std::uint32_t>(nodes_.size());
        add(at);
      }
    }
    nodes_[index] = node;
  }

 private:
  struct Children {
    ForestNode nodes[bvh_width];
    std::size_t size = 0;
  };

  /// Collects what stands for a binary node in at most `places` places.
  void collect(ForestNode at, int places, Children& children) const {
    const BinaryNode& node = forest_[at];
    const int left = node.size > 0 ? 0 : node.take[places];
    if (left == 0) {
      children.nodes[children.size++] = at;
    } else {
      collect(forest_.left(at), left, children);
      collect(forest_.right(at), places - left, children);
    }
  }

  const BinaryForest& forest_;
  std::vector<BvhNode>& nodes_;
};

/// Writes the leaves of one subtree.
void fill_leaves(Bvh& bvh, const std::vector<Sphere>& spheres, const SphereBuffers& buffers,
                 const BinaryForest::Subtree& subtree) {
  const BuildSphere* from = buffers.run(subtree.side, subtree.begin, subtree.end).data();
  std::size_t leaf = subtree.first_leaf;
  for (const BinaryNode& node : subtree.tree.nodes) {
    if (node.size == 0) continue;
    SphereBlock& block = bvh.blocks[bvh.scanned / bvh_leaf_size + leaf];
    for (std::size_t k = 0; k < node.size; ++k, ++from) {
      bvh.slots[bvh.scanned + leaf * bvh_leaf_size + k] = from->id;
      block.center_x[k] = from->at[0];
      block.center_y[k] = from->at[1];
      block.center_z[k] = from->at[2];
      block.radius[k] = spheres[static_cast<std::size_t>(from->id)].radius;
    }
    ++leaf;
  }
}

}  // namespace

SphereBlock empty_block() {
  SphereBlock block{};
  std::fill_n(block.radius, bvh_leaf_size, std::numeric_limits<float>::quiet_NaN());
  return block;
}

Bvh build_bvh(const std::vector<Sphere>& spheres, const ParallelFor& parallel_for) {
  Bvh bvh;
  bvh.slots = find_apart(spheres, parallel_for);
  const std::size_t apart = bvh.slots.size();
  bvh.scanned = padded(apart);
  if (apart == spheres.size()) {
    bvh.slots.resize(bvh.scanned, -1);
    return bvh;
  }
  SphereBuffers buffers(spheres.size() - apart);
  gather(spheres, bvh.slots, buffers, parallel_for);
  const BinaryForest forest(buffers, parallel_for);
  Collapse(forest, bvh.nodes).add(forest.root());
  bvh.slots.resize(bvh.scanned + forest.leaves() * bvh_leaf_size, -1);
  bvh.blocks.resize(bvh.slots.size() / bvh_leaf_size, empty_block());
  const bool few = buffers.size <= chunk_size;  // not worth the threads' start
  const ParallelFor leaf_for = few ? serial_for : parallel_for;
  leaf_for(forest.subtrees().size(),
           [&](std::size_t i) { fill_leaves(bvh, spheres, buffers, forest.subtrees()[i]); });
  return bvh;
}

Bvh no_bvh(std::size_t spheres) {
  Bvh bvh;
  bvh.slots.resize(spheres);
  std::iota(bvh.slots.begin(), bvh.slots.end(), 0);
  bvh.scanned = spheres;
  return bvh;
}

}  // namespace boule
