#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/search/bundle/bundle_any.h"
#include "simd/kernel/search/bundle/bundle_closest.h"
#include "simd/kernel/search/bundle/bundle_rays.h"
#include "simd/kernel/search/bundle/bundle_walk.h"
#include "simd/kernel/search/packet/parts.h"
#include "simd/kernel/search/packet/tree_blocks.h"
#include "simd/kernel/search/packet/visit_stack.h"

/// One bundle against all spheres: those outside the leaves, and the trees (bundle_walk.h).
/// bundle_stream.h makes bundles of a stream.
namespace boule::BOULE_KERNEL_ISA {

/// Tests the spheres of a geometry without parts, those outside the leaves first.
template <Common common, class Hits>
BOULE_INLINE Outcome meet_all(const BundleRays& rays, const DiscFactors& factors,
                              const GeometryView& geometry, Effort& effort, Hits& hits) {
  const SphereView& spheres = geometry.spheres;
  BundleWalk<common, Hits> walk(rays, factors, effort, hits);
  for (std::size_t slot = 0; slot < spheres.scanned && !hits.done(); slot += bvh_leaf_size) {
    walk.meet_block({spheres.blocks[slot / bvh_leaf_size], spheres.id + slot, slot},
                    spheres.scanned - slot);
  }
  return geometry.bvh.size == 0 ? Outcome::traced : walk.meet_tree(WholeTree(geometry));
}

/// Tests the spheres of a part, those outside the leaves first.
template <Common common, class Hits>
BOULE_INLINE Outcome meet_part(const PartTree& tree, BundleWalk<common, Hits>& walk, Hits& hits) {
  const std::uint32_t scanned = tree.part().scanned_spheres;
  for (std::uint32_t slot = 0; slot < scanned && !hits.done(); slot += bvh_leaf_size)
    walk.meet_block(tree.block(slot), scanned - slot);
  return tree.part().nodes == nullptr ? Outcome::traced : walk.meet_tree(tree);
}

/// Tests the spheres of all parts, near parts first.
template <Common common, class Hits>
BOULE_INLINE Outcome meet_all(const BundleRays& rays, const DiscFactors& factors,
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
    const Outcome outcome = meet_part<common>(tree, walk, hits);
    if (outcome != Outcome::traced) return outcome;
  }
  return Outcome::traced;
}

/// Finds the nearest hits of a bundle of rays.
template <Common common, class Geometry>
BOULE_NOINLINE Outcome trace_bundle(const Geometry& geometry, const RaysInOrder<common>& source,
                                    Effort& effort, const HitStream& hits) {
  BundleRays rays;
  if (!load_bundle<common, Sought::nearest>(source, rays)) return Outcome::no_bundle;
  const DiscFactors factors(rays, common);
  BundleClosest<common, SpheresOf<Geometry>> nearest(source, geometry.spheres, rays);
  const Outcome outcome = meet_all<common>(rays, factors, geometry, effort, nearest);
  if (outcome == Outcome::traced) nearest.finish(geometry.planes, hits);
  return outcome;
}

/// Finds the rays of a bundle that hit anything: for each packet, as bits.
template <Common common, class Geometry>
BOULE_NOINLINE Outcome find_occluded(const Geometry& geometry, const BundleRays& rays,
                                     const BundleStarts& starts, Effort& effort, unsigned* hit) {
  const DiscFactors factors(rays, common);
  BundleAny<common, SpheresOf<Geometry>> any(starts, geometry.spheres, rays);
  const Outcome outcome = meet_all<common>(rays, factors, geometry, effort, any);
  if (outcome == Outcome::traced) any.finish(geometry.planes, hit);
  return outcome;
}
template <Common common, class Geometry, class Source>
BOULE_NOINLINE Outcome trace_bundle(const Geometry& geometry, const Source& source, Effort& effort,
                                    std::uint8_t* occluded) {
  BundleRays rays;
  if (!load_bundle<common, Sought::any>(source, rays)) return Outcome::no_bundle;
  const BundleStarts starts(source, rays.packets);
  unsigned hit[bundle_packets];
  const Outcome outcome = find_occluded<common>(geometry, rays, starts, effort, hit);
  if (outcome != Outcome::traced) return outcome;
  for (int p = 0; p < rays.packets; ++p) source.answer(p * width, hit[p], occluded);
  return outcome;
}

}  // namespace boule::BOULE_KERNEL_ISA
