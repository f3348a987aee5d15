#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/bundle_any.h"
#include "simd/kernel/search/bundle_closest.h"
#include "simd/kernel/search/bundle_discs.h"
#include "simd/kernel/search/bundle_grid.h"
#include "simd/kernel/search/bundle_rays.h"
#include "simd/kernel/search/bundle_sides.h"
#include "simd/kernel/search/parts.h"
#include "simd/kernel/search/tree_blocks.h"
#include "simd/kernel/search/visit_stack.h"
#include "simd/kernel/tuning.h"

/// One bundle through all spheres: up to 1024 rays walk the tree together, front to back, by the
/// four sides of their extent, and in each leaf meet the spheres as discs. bundle_stream.h makes
/// bundles of a stream. The hits are exact: floats turn away or accept what they are certain of,
/// and the double solver decides the rest.
namespace boule::BOULE_KERNEL_ISA {

/// Meets some spheres. Hits: BundleClosest or BundleAny.
template <Common common, class Hits>
BOULE_INLINE void meet_spheres(const BundleRays& rays, const DiscFactors& factors,
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
  // All discs are compared with the groups before any is met. A branch after each comparison, which
  // no CPU could predict, would keep the comparisons from overlapping.
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

/// How many leaves a bundle has visited, and how many it may visit.
struct Effort {
  std::size_t most_leaves = ~std::size_t{0};
  std::size_t leaves = 0;
};

/// A bundle on its way through trees. Hits: BundleClosest or BundleAny.
template <Common common, class Hits>
class BundleWalk {
 public:
  BundleWalk(const BundleRays& rays, const DiscFactors& factors, Effort& effort, Hits& hits)
      : rays_(rays),
        factors_(factors),
        effort_(effort),
        hits_(hits),
        sides_(rays),
        fill_at_(static_cast<std::size_t>(rays.packets * width) / tuning::rays_per_leaf_if_sparse) {
  }

  /// Adds the children of a node that rays may enter, and fetches what their visits will read.
  template <class Tree>
  BOULE_INLINE void visit_children(const BvhNode& node, const Tree& tree, VisitStack& stack) {
    alignas(64) float near[Discs::size];
    unsigned in = ~sides_.find_missed(node, hits_.limit(), near) & ((1U << node.size) - 1);
    if constexpr (Hits::sought == Sought::any) {
      if (effort_.leaves >= fill_at_) {
        hits_.fill(grid_);
        fill_at_ += effort_.leaves;
      }
      if (grid_.known()) in = sides_.meet_rays(node, grid_, near, in);
    }
    const int base = stack.count();
    for (; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      stack.push({near[k], node.child[k], node.leaf_size[k]}, base);
      tree.fetch(node.child[k]);
    }
  }

  /// Meets the spheres of a tree, near nodes first. Returns false if it gave up because that takes
  /// too many leaves, or too many double solves.
  template <class Tree>
  BOULE_INLINE bool meet_tree(const Tree& tree) {
    VisitStack stack;
    stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
    while (!stack.empty() && !hits_.done()) {
      const Visit visit = stack.pop();
      if (hits_.limit() < visit.near) continue;
      if (visit.leaf_size == 0) {
        visit_children(tree.node(visit.child), tree, stack);
        continue;
      }
      if (effort_.leaves++ >= effort_.most_leaves || hits_.too_close()) return false;
      meet_block(tree.leaf(visit.child), visit.leaf_size);
    }
    return true;
  }

  /// Meets up to sixteen spheres.
  BOULE_INLINE void meet_block(const LeafRef& block, std::size_t spheres) {
    const std::size_t count = spheres < bvh_leaf_size ? spheres : bvh_leaf_size;
    meet_spheres<common>(rays_, factors_, BlockSpheres(block, static_cast<unsigned>(count)), hits_);
  }

 private:
  const BundleRays& rays_;
  const DiscFactors& factors_;
  Effort& effort_;
  Hits& hits_;
  BundleSides<common> sides_;
  RayGrid grid_;
  std::size_t fill_at_;
};

/// Meets the spheres of a geometry without parts: first those that are in no leaf.
template <Common common, class Hits>
BOULE_INLINE bool meet_all(const BundleRays& rays, const DiscFactors& factors,
                           const GeometryView& geometry, Effort& effort, Hits& hits) {
  const SphereView& spheres = geometry.spheres;
  BundleWalk<common, Hits> walk(rays, factors, effort, hits);
  for (std::size_t slot = 0; slot < spheres.scanned && !hits.done(); slot += bvh_leaf_size) {
    walk.meet_block({spheres.blocks[slot / bvh_leaf_size], spheres.id + slot, slot},
                    spheres.scanned - slot);
  }
  return geometry.bvh.size == 0 || walk.meet_tree(WholeTree(geometry));
}

/// Meets the spheres of a part: first those that are in no leaf.
template <Common common, class Hits>
BOULE_INLINE bool meet_part(const PartTree& tree, BundleWalk<common, Hits>& walk, Hits& hits) {
  const std::uint32_t scanned = tree.part().scanned_spheres;
  for (std::uint32_t slot = 0; slot < scanned && !hits.done(); slot += bvh_leaf_size)
    walk.meet_block(tree.block(slot), scanned - slot);
  return tree.part().nodes == nullptr || walk.meet_tree(tree);
}

/// What a bundle fetches of the tree over the parts: nothing.
struct NoFetch {
  BOULE_INLINE void fetch(std::uint32_t /*child*/) const {}
};

/// Meets the spheres of all parts, near parts first.
template <Common common, class Hits>
BOULE_INLINE bool meet_all(const BundleRays& rays, const DiscFactors& factors,
                           const PartsGeometry& geometry, Effort& effort, Hits& hits) {
  BundleWalk<common, Hits> walk(rays, factors, effort, hits);
  VisitStack stack;
  stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
  while (!stack.empty() && !hits.done()) {
    const Visit visit = stack.pop();
    if (hits.limit() < visit.near) continue;
    if (visit.leaf_size == 0) {
      walk.visit_children(geometry.bvh.nodes[visit.child], NoFetch(), stack);
      continue;
    }
    const PartTree tree(geometry.spheres.part(index_of(visit.child)));
    if (!meet_part<common>(tree, walk, hits)) return false;
  }
  return true;
}

/// How the search of a bundle ended: with an answer, because its rays are no bundle, or because it
/// gave up.
enum class Outcome { traced, no_bundle, gave_up };

/// Finds the nearest hits of a bundle of rays.
template <Common common, class Geometry>
BOULE_NOINLINE Outcome trace_bundle(const Geometry& geometry, const RaysInOrder<common>& source,
                                    Effort& effort, const HitStream& hits) {
  BundleRays rays;
  if (!load_bundle<common, Sought::nearest>(source, rays)) return Outcome::no_bundle;
  const DiscFactors factors(rays, common);
  BundleClosest<common, SpheresOf<Geometry>> nearest(source, geometry.spheres, rays);
  if (!meet_all<common>(rays, factors, geometry, effort, nearest)) return Outcome::gave_up;
  nearest.finish(geometry.planes, hits);
  return Outcome::traced;
}

/// Finds which rays of a bundle hit anything.
template <Common common, class Geometry, class Source>
BOULE_NOINLINE Outcome trace_bundle(const Geometry& geometry, const Source& source, Effort& effort,
                                    std::uint8_t* occluded) {
  BundleRays rays;
  if (!load_bundle<common, Sought::any>(source, rays)) return Outcome::no_bundle;
  const DiscFactors factors(rays, common);
  BundleAny<common, Source, SpheresOf<Geometry>> any(source, geometry.spheres, rays);
  if (!meet_all<common>(rays, factors, geometry, effort, any)) return Outcome::gave_up;
  any.finish(geometry.planes, occluded);
  return Outcome::traced;
}

}  // namespace boule::BOULE_KERNEL_ISA
