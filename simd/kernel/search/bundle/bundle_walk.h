#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/abi/bvh.h"
#include "simd/kernel/search/bundle/bundle_any.h"
#include "simd/kernel/search/bundle/bundle_discs.h"
#include "simd/kernel/search/bundle/bundle_footprints.h"
#include "simd/kernel/search/bundle/bundle_grid.h"
#include "simd/kernel/search/bundle/bundle_rays.h"
#include "simd/kernel/search/bundle/bundle_sides.h"
#include "simd/kernel/search/packet/visit_stack.h"
#include "simd/kernel/tuning.h"

/// The traversal of trees by a bundle: up to 1024 rays go together, front to back. The four sides
/// of their extent reject boxes, and in each leaf the rays meet the spheres as discs. The hits are
/// exact: floats reject or accept where they are certain, and the double solver decides the rest.
namespace boule::BOULE_KERNEL_ISA {

/// Tests some spheres. Hits: BundleClosest or BundleAny.
template <Common common, class Hits>
BOULE_NOINLINE void meet_spheres(const BundleRays& rays, const DiscFactors& factors,
                                 const BlockSpheres& spheres, Hits& hits) {
  Discs discs;
  locate_discs<common, Hits::sought>(rays, factors, spheres, hits.limit(), discs);
  for (unsigned left = discs.awkward; left != 0; left &= left - 1)
    hits.meet_awkward(spheres.slot(std::countr_zero(left)));
  if (discs.simple == 0) return;
  bound_discs<common, Hits::sought>(factors, spheres.parts(), discs);
  if constexpr (Hits::sought == Sought::any) {
    if (hits.meet_few(discs, spheres)) return;
  }
  // All discs are compared with the groups before any is tested. A branch after each comparison
  // would be unpredictable and would keep the comparisons from overlapping.
  unsigned groups_of[Discs::size], wanted = 0;
  for (unsigned left = discs.simple; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    groups_of[k] = groups_near(rays.groups, hits.limits(), discs, k);
    wanted |= (groups_of[k] != 0 ? 1U : 0U) << k;
  }
  bool changed = false;
  for (; wanted != 0; wanted &= wanted - 1) {
    const int k = std::countr_zero(wanted);
    const DiscLanes disc = DiscLanes::same(discs, k);
    const std::uint32_t slot = spheres.slot(k);
    for (unsigned groups = groups_of[k]; groups != 0; groups &= groups - 1)
      changed |= hits.meet(std::countr_zero(groups), disc, slot);
  }
  if (changed) hits.update();
}

/// The outcome of a bundle's search: an answer; or an early end because its rays form no bundle,
/// because it took too much work, or because its leaves serve too few of its rays.
enum class Outcome { traced, no_bundle, gave_up, sparse };

/// The number of leaves a bundle has visited, and the number it may visit.
struct Effort {
  std::size_t most_leaves = ~std::size_t{0};
  std::size_t leaves = 0;
};

/// The prefetcher of a bundle in the tree over the parts: it fetches nothing.
struct NoFetch {
  BOULE_INLINE void fetch(std::uint32_t /*child*/) const {}
};

/// A bundle during traversal. Hits: BundleClosest or BundleAny.
template <Common common, class Hits>
class BundleWalk {
 public:
  BundleWalk(const BundleRays& rays, const DiscFactors& factors, Effort& effort, Hits& hits)
      : rays_(rays),
        factors_(factors),
        effort_(effort),
        hits_(hits),
        sides_(rays),
        footprints_(rays),
        look_at_(static_cast<std::size_t>(rays.packets * width) / tuning::rays_per_leaf_if_sparse),
        fill_at_(look_at_) {}

  /// Adds the children of a node that rays may enter, and prefetches the data of their visits. In
  /// the tree over the parts, the leaves are parts.
  template <class Tree>
  BOULE_INLINE void visit_children(const BvhNode& node, const Tree& tree, VisitStack& stack) {
    alignas(64) float near[Discs::size];
    unsigned in = ~sides_.find_missed(node, hits_.limit(), near) & ((1U << node.size) - 1);
    constexpr bool has_leaves = !std::is_same_v<Tree, NoFetch>;
    if (effort_.leaves >= look_at_) in = look_closely<has_leaves>(node, near, in);
    const int base = stack.count();
    for (; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      stack.push({near[k], node.child[k], node.leaf_size[k]}, base);
      tree.fetch(node.child[k]);
    }
  }

  /// Tests the spheres of a tree, near nodes first. Gives up where that takes too many leaves or
  /// too many double solves, or where leaves serve too few rays.
  template <class Tree>
  BOULE_INLINE Outcome meet_tree(const Tree& tree) {
    VisitStack stack;
    stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
    while (!stack.empty() && !hits_.done()) {
      const Visit visit = stack.pop();
      if (hits_.limit() < visit.near) continue;
      if (visit.leaf_size == 0) {
        visit_children(tree.node(visit.child), tree, stack);
        if (footprints_.are_small(fewest_rays)) return Outcome::sparse;
        continue;
      }
      if (effort_.leaves++ >= effort_.most_leaves || hits_.too_close()) return Outcome::gave_up;
      meet_block(tree.leaf(visit.child), visit.leaf_size);
    }
    return Outcome::traced;
  }

  /// Tests up to sixteen spheres.
  BOULE_INLINE void meet_block(const LeafRef& block, std::size_t spheres) {
    const std::size_t count = spheres < bvh_leaf_size ? spheres : bvh_leaf_size;
    meet_spheres<common>(rays_, factors_, BlockSpheres(block, static_cast<unsigned>(count)), hits_);
  }

 private:
  static constexpr float fewest_rays = tuning::fewest_rays_of_a_leaf<Hits::sought == Sought::any>;

  /// The children among `entered`, as bits, that some ray of a sparse bundle may enter. `near`: the
  /// result of find_missed().
  template <bool has_leaves>
  BOULE_NOINLINE unsigned look_closely(const BvhNode& node, const float* near, unsigned entered) {
    BoxViews views;
    unsigned in = entered;
    if constexpr (Hits::sought == Sought::any) {
      if (effort_.leaves >= fill_at_) {
        hits_.fill(grid_);
        fill_at_ += effort_.leaves;
      }
      sides_.view(node, rays_.extent, views);
      in = grid_.meet_boxes(views, near, entered);
    } else {
      const unsigned behind = entered & beyond(hits_.least_limit(), near);
      if (footprints_.are_known() && (behind == 0 || pause_.goes_on())) return entered;
      sides_.view(node, rays_.extent, views);
      in = (entered & ~behind) | before_limits(views, near, behind);
      pause_.look(4 * count_bits(entered & ~in) >= count_bits(entered));
    }
    if (has_leaves && !footprints_.are_known()) footprints_.add(node, views, in);
    return in;
  }

  /// The boxes, as bits, that are entered only beyond `limit`; boxes whose `near` is NaN are left
  /// out.
  BOULE_INLINE static unsigned beyond(float limit, const float* near) {
    unsigned result = 0;
    for (int at = 0; at < Discs::size; at += width)
      result |= bits(Real(limit) < load(near + at)) << at;
    return result;
  }
  /// The boxes, as bits, that some group of rays may enter before its limit.
  BOULE_NOINLINE unsigned before_limits(const BoxViews& views, const float* near,
                                        unsigned boxes) const {
    unsigned result = 0;
    for (unsigned left = boxes; left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      const Extent extent = {views.a_low[k], views.a_high[k], views.b_low[k], views.b_high[k]};
      if (groups_near(rays_.groups, hits_.limits(), extent, near[k]) != 0) result |= 1U << k;
    }
    return result;
  }

  const BundleRays& rays_;
  const DiscFactors& factors_;
  Effort& effort_;
  Hits& hits_;
  BundleSides<common> sides_;
  RayGrid grid_;
  Footprints footprints_;
  Pause pause_;
  std::size_t look_at_, fill_at_;
};

}  // namespace boule::BOULE_KERNEL_ISA
