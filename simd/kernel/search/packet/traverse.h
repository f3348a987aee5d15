#pragma once

#include <bit>
#include <cstdint>

#include "simd/abi/bvh.h"
#include "simd/kernel/search/leaf/scan.h"
#include "simd/kernel/search/leaf/slabs.h"
#include "simd/kernel/search/packet/packet_walk.h"
#include "simd/kernel/search/packet/parts.h"
#include "simd/kernel/search/packet/short_walk.h"
#include "simd/kernel/search/packet/tree_blocks.h"
#include "simd/kernel/search/packet/visit_stack.h"

/// Packets and single rays during traversal of the tree: depth first, near children first. Chosen
/// where rays have no promised coherence and Form or a trial (scattered_stream.h) says packet or
/// single. Boxes are filters like the reject: they turn away only certain misses. The hits are
/// therefore those of a scan, whatever the order of visits.
namespace boule::BOULE_KERNEL_ISA {

/// One ray, the same in every lane, during traversal: W children at a time.
class SingleWalk {
 public:
  BOULE_INLINE SingleWalk(const RayLanes& rays, float extent)
      : rays_(rays.filter), box_rays_(rays, extent) {}

  BOULE_INLINE void visit_children(const BvhNode& node, unsigned, const Real&, float limit,
                                   VisitStack& stack) const {
    const int base = stack.count();
    for (int first = 0; first < node.size; first += width) {
      const auto get = [&](const float* row) { return load(row + first); };
      const Boxes boxes{{get(node.min_x), get(node.min_y), get(node.min_z)},
                        {get(node.max_x), get(node.max_y), get(node.max_z)}};
      const Entry entry = enter_boxes(box_rays_, boxes, Real(limit));
      alignas(64) float near[width];
      store(near, entry.near);
      const unsigned there = (1U << (node.size - first < width ? node.size - first : width)) - 1;
      for (unsigned in = there & ~bits(entry.out); in != 0; in &= in - 1) {
        const int lane = std::countr_zero(in), k = first + lane;
        const float at = near[lane] == near[lane] ? near[lane] : -static_cast<float>(no_hit);
        stack.push({at, node.child[k], node.leaf_size[k]}, base);
      }
    }
  }
  BOULE_INLINE void list_survivors(const LeafSpheres<OnePerLane>& leaf, unsigned, const Real&,
                                   float, Survivors<bvh_leaf_size>& survivors) const {
    const auto out = [&](std::size_t step) { return leaf.out(rays_, step); };
    boule::BOULE_KERNEL_ISA::list_survivors(out, 0, OnePerLane::steps(leaf.size), survivors);
  }

 private:
  const FilterRays& rays_;
  BoxRays box_rays_;
};

/// The limit of the search: for W rays the largest of their limits; for one ray, for which all
/// lanes search, the smallest. inf if a lane's limit is NaN.
template <class Access>
BOULE_INLINE float limit_of_all(const Real& limit) {
  if (bits(limit <= limit) != all_lanes) return static_cast<float>(no_hit);
  return Access::one_ray ? least_lane(limit) : greatest_lane(limit);
}

/// The number of children of a node that short rays visit untested.
BOULE_INLINE int untested_of(const BvhView& bvh) {
  return bvh.size == 1 ? static_cast<int>(bvh_width) : tuning::most_untested;
}

/// Calls search(walk) with the walk that suits these rays. Returns the result of search().
template <class Access, class Best, class Search>
BOULE_INLINE std::size_t with_walk(const RayLanes& rays, const Best& best, const BvhView& bvh,
                                   const Search& search) {
  if constexpr (Access::one_ray) {
    SingleWalk walk(rays, bvh.extent);
    return search(walk);
  } else {
    if constexpr (!Best::ordered) {
      const ReachBox reach(rays.filter, best.limit(), bvh.extent);
      if (reach.is_short() && !forms_beam(rays.filter)) {
        ShortWalk<1> walk(&rays, reach, untested_of(bvh), bvh.extent);
        return search(walk);
      }
    }
    PacketWalk<Best::ordered> walk(rays, bvh.extent);
    return search(walk);
  }
}

/// Whether the child of `visit` certainly lies beyond `limit`.
BOULE_INLINE bool is_beyond(const Visit& visit, float limit) {
  const float slack = static_cast<float>(filter::box * filter::u);
  const float size = visit.near < 0 ? -visit.near : visit.near;
  return limit < visit.near - size * slack;
}

/// Tests up to sixteen spheres. `all`: the spheres of all slots.
template <class Access, class Walk, class All, class Best>
BOULE_INLINE void meet_leaf(const RayLanes& rays, Solver solver, Walk& walk, const All& all,
                            const LeafRef& at, std::uint32_t size, unsigned lanes, float& limit,
                            Best& best) {
  const LeafSpheres<Access> leaf(at, size);
  Survivors<bvh_leaf_size> survivors;
  walk.list_survivors(leaf, lanes, best.limit(), limit, survivors);
  if (survivors.count == 0) return;
  meet_survivors(rays, solver, all, leaf, 0, survivors, best);
  limit = limit_of_all<Access>(best.limit());
}

/// Searches a tree. Returns the number of visited nodes and leaves.
template <class Access, class Walk, class Tree, class All, class Best>
BOULE_INLINE std::size_t traverse_tree(const RayLanes& rays, Solver solver, Walk& walk,
                                       const Tree& tree, const All& all, Best& best) {
  std::size_t visits = 0;
  VisitStack stack;
  stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
  float limit = limit_of_all<Access>(best.limit());
  while (!stack.empty() && !best.done()) {
    const Visit visit = stack.pop();
    if (is_beyond(visit, limit)) continue;
    const unsigned lanes = best.open(visit.lanes);
    if (lanes == 0) continue;
    ++visits;
    if (visit.leaf_size == 0) {
      walk.visit_children(tree.node(visit.child), lanes, best.limit(), limit, stack);
    } else {
      meet_leaf<Access>(rays, solver, walk, all, tree.leaf(visit.child), visit.leaf_size, lanes,
                        limit, best);
    }
  }
  return visits;
}

/// Searches the tree of a geometry without parts.
template <class Access, class Best>
BOULE_INLINE std::size_t traverse_spheres(const RayLanes& rays, Solver solver,
                                          const GeometryView& geometry, Best& best) {
  if (geometry.bvh.size == 0) return 0;
  return with_walk<Access>(rays, best, geometry.bvh, [&](auto& walk) {
    return traverse_tree<Access>(rays, solver, walk, WholeTree(geometry), geometry.spheres, best);
  });
}

/// Scans the spheres of a geometry without a tree for short any-hit rays: the spheres within their
/// reach box. Returns false if there is a tree, if the spheres are few, or if the rays are not
/// short.
template <class Best>
BOULE_INLINE bool scan_reached(const RayLanes& rays, Solver solver, const GeometryView& geometry,
                               Best& best) {
  const SphereView& spheres = geometry.spheres;
  if (geometry.bvh.size != 0 || spheres.scanned <= tuning::most_unasked) return false;
  const ReachBox reach(rays.filter, best.limit(), geometry.bvh.extent);
  if (!reach.is_short()) return false;
  const ScannedSpheres<OneForAll> scanned{spheres};
  for (std::size_t slot = 0; slot < spheres.scanned && !best.done(); slot += bvh_leaf_size) {
    const std::size_t left = spheres.scanned - slot;
    const unsigned there = left < bvh_leaf_size ? (1U << left) - 1 : ~0U;
    const unsigned in = reach.meet(spheres.blocks[slot / bvh_leaf_size]) & there;
    Survivors<bvh_leaf_size> survivors;
    list_among(rays.filter, scanned, slot, in, all_lanes, survivors);
    meet_survivors(rays, solver, spheres, scanned, slot, survivors, best);
  }
  return true;
}

/// Searches all spheres: those outside the leaves first, then the tree.
template <class Access, class Best>
BOULE_INLINE std::size_t search_spheres(const RayLanes& rays, Solver solver,
                                        const GeometryView& geometry, Best& best) {
  if constexpr (!Access::one_ray && !Best::ordered) {
    if (scan_reached(rays, solver, geometry, best)) return 0;
  }
  scan_spheres<Access>(rays, solver, geometry.spheres, best);
  return traverse_spheres<Access>(rays, solver, geometry, best);
}

/// Tests up to sixteen spheres outside the leaves, which may be beyond the range of most filters.
template <class Access, class All, class Best>
BOULE_INLINE void meet_scanned(const RayLanes& rays, Solver solver, const All& all,
                               const LeafRef& at, std::uint32_t size, Best& best) {
  const LeafSpheres<Access> spheres(at, size);
  Survivors<bvh_leaf_size> survivors;
  const auto out = [&](std::size_t step) { return spheres.out(rays.filter, step); };
  list_survivors(out, 0, Access::steps(size), survivors);
  meet_survivors(rays, solver, all, spheres, 0, survivors, best);
}

/// Searches a part: its spheres outside the leaves first, then its tree.
template <class Access, class Walk, class Best>
BOULE_INLINE std::size_t search_part(const RayLanes& rays, Solver solver, Walk& walk,
                                     const PartTree& tree, const PartSpheres& all, Best& best) {
  const std::uint32_t scanned = tree.part().scanned_spheres;
  for (std::uint32_t slot = 0; slot < scanned && !best.done(); slot += bvh_leaf_size) {
    const std::uint32_t rest = scanned - slot;
    meet_scanned<Access>(rays, solver, all, tree.block(slot),
                         rest < bvh_leaf_size ? rest : static_cast<std::uint32_t>(bvh_leaf_size),
                         best);
  }
  if (tree.part().nodes == nullptr) return 0;
  return traverse_tree<Access>(rays, solver, walk, tree, all, best);
}

/// Searches all parts, near ones first.
template <class Access, class Walk, class Best>
BOULE_INLINE std::size_t search_parts(const RayLanes& rays, Solver solver, Walk& walk,
                                      const PartsGeometry& geometry, Best& best) {
  std::size_t visits = 0;
  VisitStack stack;
  stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
  while (!stack.empty() && !best.done()) {
    const Visit visit = stack.pop();
    const float limit = limit_of_all<Access>(best.limit());
    if (is_beyond(visit, limit)) continue;
    ++visits;
    if (visit.leaf_size == 0) {
      walk.visit_children(geometry.bvh.nodes[visit.child], visit.lanes, best.limit(), limit, stack);
    } else {
      const PartTree tree(geometry.spheres.part(index_of(visit.child)));
      visits += search_part<Access>(rays, solver, walk, tree, geometry.spheres, best);
    }
  }
  return visits;
}
template <class Access, class Best>
BOULE_INLINE std::size_t search_spheres(const RayLanes& rays, Solver solver,
                                        const PartsGeometry& geometry, Best& best) {
  return with_walk<Access>(rays, best, geometry.bvh, [&](auto& walk) {
    return search_parts<Access>(rays, solver, walk, geometry, best);
  });
}

/// Searches all primitives. Returns the number of visited nodes and leaves. Geometry: GeometryView,
/// or PartsGeometry.
template <class Access, class Geometry, class Best>
BOULE_NOINLINE std::size_t search(const RayLanes& rays, Solver solver, const Geometry& geometry,
                                  Best& best) {
  const std::size_t visits = search_spheres<Access>(rays, solver, geometry, best);
  best.settle(geometry.spheres, rays);
  scan_planes<Access>(rays, solver, geometry.planes, best);
  return visits;
}

}  // namespace boule::BOULE_KERNEL_ISA
