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

/// Meets the spheres that are in no leaf.
template <Common common, class Hits>
BOULE_INLINE void meet_scanned(const BundleRays& rays, const DiscFactors& factors,
                               const SphereView& spheres, Hits& hits) {
  const auto count_from = [&](std::size_t first) {
    const std::size_t rest = spheres.scanned - first;
    return static_cast<unsigned>(rest < bvh_leaf_size ? rest : bvh_leaf_size);
  };
  for (std::size_t first = 0; first < spheres.scanned && !hits.done(); first += bvh_leaf_size) {
    const BlockSpheres block(spheres, first, count_from(first));
    meet_spheres<common>(rays, factors, block, hits);
  }
}

/// How many leaves a bundle has visited, and how many it may visit.
struct Effort {
  std::size_t most_leaves = ~std::size_t{0};
  std::size_t leaves = 0;
};

/// Meets the spheres of the tree, near nodes first. Returns false if it gave up because that takes
/// too many leaves, or too many double solves.
template <Common common, class Hits>
BOULE_INLINE bool meet_tree(const BundleRays& rays, const DiscFactors& factors,
                            const GeometryView& geometry, Effort& effort, Hits& hits) {
  if (geometry.bvh.size == 0) return true;
  const BundleSides<common> sides(rays);
  const SphereView& spheres = geometry.spheres;
  const TreeBlocks blocks(geometry);
  VisitStack stack;
  stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
  RayGrid grid;
  std::size_t fill_at =
      static_cast<std::size_t>(rays.packets * width) / tuning::rays_per_leaf_if_sparse;
  while (!stack.empty() && !hits.done()) {
    const Visit visit = stack.pop();
    if (hits.limit() < visit.near) continue;
    if (visit.leaf_size != 0) {
      if (effort.leaves++ >= effort.most_leaves || hits.too_close()) return false;
      const std::size_t first =
          spheres.scanned + std::size_t{index_of(visit.child)} * bvh_leaf_size;
      const BlockSpheres leaf(spheres, first, visit.leaf_size);
      meet_spheres<common>(rays, factors, leaf, hits);
      continue;
    }
    const BvhNode& node = geometry.bvh.nodes[visit.child];
    alignas(64) float near[Discs::size];
    unsigned in = ~sides.find_missed(node, hits.limit(), near) & ((1U << node.size) - 1);
    if constexpr (Hits::sought == Sought::any) {
      if (effort.leaves >= fill_at) {
        hits.fill(grid);
        fill_at += effort.leaves;
      }
      if (grid.known()) in = sides.meet_rays(node, grid, near, in);
    }
    const int base = stack.count();
    for (; in != 0; in &= in - 1) {
      const int k = std::countr_zero(in);
      stack.push({near[k], node.child[k], node.leaf_size[k]}, base);
      blocks.fetch(node.child[k]);
    }
  }
  return true;
}

/// How the search of a bundle ended: with an answer, because its rays are no bundle, or because it
/// gave up.
enum class Outcome { traced, no_bundle, gave_up };

/// Finds the nearest hits of a bundle of rays.
template <Common common>
BOULE_NOINLINE Outcome trace_bundle(const GeometryView& geometry, const RaysInOrder<common>& source,
                                    Effort& effort, const HitStream& hits) {
  BundleRays rays;
  if (!load_bundle<common, Sought::nearest>(source, rays)) return Outcome::no_bundle;
  const DiscFactors factors(rays, common);
  BundleClosest<common> nearest(source, geometry.spheres, rays);
  meet_scanned<common>(rays, factors, geometry.spheres, nearest);
  if (!meet_tree<common>(rays, factors, geometry, effort, nearest)) return Outcome::gave_up;
  nearest.finish(geometry.planes, hits);
  return Outcome::traced;
}

/// Finds which rays of a bundle hit anything.
template <Common common, class Source>
BOULE_NOINLINE Outcome trace_bundle(const GeometryView& geometry, const Source& source,
                                    Effort& effort, std::uint8_t* occluded) {
  BundleRays rays;
  if (!load_bundle<common, Sought::any>(source, rays)) return Outcome::no_bundle;
  const DiscFactors factors(rays, common);
  BundleAny<common, Source> any(source, geometry.spheres, rays);
  meet_scanned<common>(rays, factors, geometry.spheres, any);
  if (!meet_tree<common>(rays, factors, geometry, effort, any)) return Outcome::gave_up;
  any.finish(geometry.planes, occluded);
  return Outcome::traced;
}

}  // namespace boule::BOULE_KERNEL_ISA
