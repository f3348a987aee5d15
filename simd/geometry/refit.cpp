#include "simd/geometry/refit.h"

#include <algorithm>
#include <atomic>

#include "simd/geometry/build_box.h"
#include "simd/geometry/node_boxes.h"
#include "simd/geometry/tuning.h"

namespace boule {
namespace {

constexpr std::size_t nodes_of_chunk = 256;

/// Calls body(first, end) for all of `count`, `size` at a time.
void in_chunks(const ParallelFor& parallel_for, std::size_t count, std::size_t size,
               const auto& body) {
  parallel_for((count + size - 1) / size,
               [&](std::size_t i) { body(i * size, std::min((i + 1) * size, count)); });
}

bool all_in_filter_range(std::span<const Sphere> spheres, const ParallelFor& parallel_for) {
  std::atomic<bool> all{true};
  in_chunks(parallel_for, spheres.size(), tuning::chunk_size,
            [&](std::size_t first, std::size_t end) {
              const auto some = spheres.subspan(first, end - first);
              if (!std::all_of(some.begin(), some.end(), in_filter_range)) all = false;
            });
  return all;
}

/// Moves the spheres in one block. Returns their box.
BuildBox refit_block(Bvh& tree, std::size_t index, std::span<const Sphere> spheres) {
  SphereBlock& block = tree.blocks[index];
  const std::int32_t* const ids = tree.slots.data() + index * bvh_leaf_size;
  BuildBox box;
  for (std::size_t k = 0; k < bvh_leaf_size && ids[k] >= 0; ++k) {
    const Sphere& s = spheres[static_cast<std::size_t>(ids[k])];
    block.center_x[k] = s.center.x;
    block.center_y[k] = s.center.y;
    block.center_z[k] = s.center.z;
    block.radius[k] = s.radius;
    box.add(outward_box({{s.center.x, s.center.y, s.center.z, s.radius}, ids[k]}));
  }
  return box;
}

BuildBox box_of_children(const BvhNode& node) {
  BuildBox box;
  for (std::size_t k = 0; k < node.size; ++k) box.add(child_box(node, k));
  return box;
}

}  // namespace

double tree_cost(const Bvh& tree) {
  double all = 0, of_root = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const BvhNode& node = tree.nodes[i];
    for (std::size_t k = 0; k < node.size; ++k) all += child_box(node, k).area();
    if (i == 0) of_root = all;
  }
  return of_root > 0 ? all / of_root : 0;
}

bool refit(Bvh& tree, std::span<const Sphere> spheres, const ParallelFor& parallel_for) {
  if (!tree.copies.empty() || !all_in_filter_range(spheres, parallel_for)) return false;
  const std::size_t first_leaf = tree.scanned / bvh_leaf_size;
  for (std::size_t block = 0; block < first_leaf; ++block) refit_block(tree, block, spheres);
  in_chunks(parallel_for, tree.nodes.size(), nodes_of_chunk,
            [&](std::size_t first, std::size_t end) {
              for (std::size_t i = first; i < end; ++i) {
                BvhNode& node = tree.nodes[i];
                for (std::size_t k = 0; k < node.size; ++k) {
                  if ((node.child[k] & leaf_bit) == 0) continue;
                  const std::size_t leaf = index_of(node.child[k]);
                  set_child_box(node, k, refit_block(tree, first_leaf + leaf, spheres));
                }
              }
            });
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parents
    BvhNode& node = tree.nodes[i];
    for (std::size_t k = 0; k < node.size; ++k) {
      if ((node.child[k] & leaf_bit) != 0) continue;
      set_child_box(node, k, box_of_children(tree.nodes[index_of(node.child[k])]));
    }
  }
  return true;
}

}  // namespace boule
