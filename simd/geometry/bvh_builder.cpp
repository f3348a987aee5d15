#include "simd/geometry/bvh_builder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "simd/abi/isa.h"
#include "simd/geometry/binary_forest.h"
#include "simd/geometry/filter_range.h"

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

/// Spheres in three sorts.
struct Sorted {
  std::vector<std::int32_t> unfit;   ///< those that fit no box, in order
  std::vector<std::int32_t> giants;  ///< those whose box is too large, in order
  BuildBox rest;                     ///< the box of all others
};

void sort(const std::vector<Sphere>& spheres, std::size_t first, std::size_t end, double giant_area,
          Sorted& sorted) {
  BuildBox rest;
  for (std::size_t i = first; i < end; ++i) {
    const auto id = static_cast<std::int32_t>(i);
    if (!in_filter_range(spheres[i])) {
      sorted.unfit.push_back(id);
      continue;
    }
    const Sphere& s = spheres[i];  // no BuildSphere: four stores and one load would wait
    const BuildBox box = rough_box(Float4{s.center.x, s.center.y, s.center.z, std::fabs(s.radius)});
    if (box.area() > giant_area) {
      sorted.giants.push_back(id);
    } else {
      rest.add(box);
    }
  }
  sorted.rest = rest;
}

Sorted sort(const std::vector<Sphere>& spheres, double giant_area,
            const ParallelFor& parallel_for) {
  std::vector<Sorted> chunks(spheres.size() / chunk_size + 1);
  for_chunks(parallel_for, spheres.size(), [&](auto chunk, std::size_t first, std::size_t end) {
    sort(spheres, first, end, giant_area, chunks[chunk]);
  });
  Sorted all;
  for (const Sorted& some : chunks) {
    all.unfit.insert(all.unfit.end(), some.unfit.begin(), some.unfit.end());
    all.giants.insert(all.giants.end(), some.giants.begin(), some.giants.end());
    all.rest.add(some.rest);
  }
  return all;
}

/// Leaves the largest `most` of `ids`, in order; of equal ones the first.
void keep_largest(std::vector<std::int32_t>& ids, std::size_t most,
                  const std::vector<Sphere>& spheres) {
  if (ids.size() <= most) return;
  const auto end = ids.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(ids.begin(), end, ids.end(), [&](std::int32_t a, std::int32_t b) {
    const float ra = std::fabs(spheres[static_cast<std::size_t>(a)].radius);
    const float rb = std::fabs(spheres[static_cast<std::size_t>(b)].radius);
    return ra != rb ? ra > rb : a < b;
  });
  ids.erase(end, ids.end());
  std::sort(ids.begin(), ids.end());
}

/// The spheres that no tree should hold, in order: those that fit no box, and the first few giants.
/// With giants away the box of all is smaller, and what remains is judged again: a dome on a ground
/// sphere is a giant as well. As the box shrinks so does the bound: each pass finds those of the
/// passes before again. Where they are too many the largest go, since each is one box less that
/// nearly every ray meets.
std::vector<std::int32_t> find_apart(const std::vector<Sphere>& spheres,
                                     const ParallelFor& parallel_for) {
  constexpr std::size_t most = 16;
  Sorted sorted = sort(spheres, BuildBox::inf, parallel_for);
  while (sorted.giants.size() < most) {
    Sorted next = sort(spheres, 0.25 * sorted.rest.area(), parallel_for);
    if (next.giants.size() <= sorted.giants.size()) break;  // fewer: nothing remained
    sorted = std::move(next);
  }
  keep_largest(sorted.giants, most, spheres);
  std::vector<std::int32_t> apart;
  std::merge(sorted.unfit.begin(), sorted.unfit.end(), sorted.giants.begin(), sorted.giants.end(),
             std::back_inserter(apart));
  return apart;
}

/// The bits of a sphere's centre and radius: any floats, in an order.
std::array<std::uint32_t, 4> bits_of(const Sphere& s) {
  return {std::bit_cast<std::uint32_t>(s.center.x), std::bit_cast<std::uint32_t>(s.center.y),
          std::bit_cast<std::uint32_t>(s.center.z), std::bit_cast<std::uint32_t>(s.radius)};
}

/// Of exact copies only the first kept_copies. In order, as `ids` are.
std::vector<std::int32_t> without_copies(std::vector<std::int32_t> ids,
                                         const std::vector<Sphere>& spheres) {
  const auto bits = [&](std::int32_t id) { return bits_of(spheres[static_cast<std::size_t>(id)]); };
  std::sort(ids.begin(), ids.end(), [&](std::int32_t a, std::int32_t b) {
    return std::pair(bits(a), a) < std::pair(bits(b), b);
  });
  std::size_t kept = 0;
  for (const std::int32_t id : ids) {
    const bool one_too_many = kept >= kept_copies && bits(ids[kept - kept_copies]) == bits(id);
    if (!one_too_many) ids[kept++] = id;
  }
  ids.resize(kept);
  std::sort(ids.begin(), ids.end());
  return ids;
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
        node.child[k] = (forest_.subtrees()[at.tree].first_leaf + child.right) | leaf_bit;
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
    from += node.copies;
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
  const std::vector<std::int32_t> apart = find_apart(spheres, parallel_for);
  bvh.slots = without_copies(apart, spheres);
  bvh.scanned = padded(bvh.slots.size());
  if (apart.size() == spheres.size()) {
    bvh.slots.resize(bvh.scanned, -1);
    return bvh;
  }
  SphereBuffers buffers(spheres.size() - apart.size());
  gather(spheres, apart, buffers, parallel_for);
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
