#pragma once

#include "simd/abi/bvh.h"
#include "simd/kernel/scan.h"

/// Spheres in a tree. Boxes are filters like the reject: what they turn away is missed for certain,
/// whatever order they are visited in, so the answer is the scan's.
namespace boule::BOULE_KERNEL_ISA {

/// Rays as box tests see them.
struct BoxRays {
  Vec3<Real> org, inverse;  ///< 1 / unit direction
  Real from;                ///< nothing is live below this t |dir|; NaN: every box is entered

  BOULE_INLINE explicit BoxRays(const FilterRays& rays)
      : org(rays.org),
        inverse{Real(1.0F) / rays.unit.x, Real(1.0F) / rays.unit.y, Real(1.0F) / rays.unit.z},
        // Far beyond the filter's range a component that underflows still leads somewhere.
        from(select(rays.unit.x <= rays.unit.x, rays.dead_below, rays.unit.x)) {}
};

/// Boxes in lanes: one for a packet, or several for a ray.
struct Boxes {
  Vec3<Real> min, max;
};

/// Where rays enter boxes, and the lanes in which they certainly do not before `limit`.
///
/// By filter_bounds.h, filter::box on either side. NaN (a ray that the filter cannot judge) passes
/// every comparison.
struct Entry {
  Real near;
  RealMask out;
};

/// One axis: [near, far] cut to the slab's.
BOULE_INLINE void cut_to_slab(const Real& low, const Real& high, const Real& org,
                              const Real& inverse, Real& near, Real& far) {
  const Real floor(static_cast<float>(filter::floor));
  const Real a = (low - org - floor) * inverse, b = (high - org + floor) * inverse;
  near = greater_or(lesser_or(a, b), near);
  far = lesser_or(greater_or(b, a), far);
}

BOULE_INLINE Entry enter_boxes(const BoxRays& rays, const Boxes& boxes, const Real& limit) {
  Real near = rays.from, far = limit;
  cut_to_slab(boxes.min.x, boxes.max.x, rays.org.x, rays.inverse.x, near, far);
  cut_to_slab(boxes.min.y, boxes.max.y, rays.org.y, rays.inverse.y, near, far);
  cut_to_slab(boxes.min.z, boxes.max.z, rays.org.z, rays.inverse.z, near, far);
  // By products: beside a slab, and along it, near is infinite and has to stay so.
  const Real less(static_cast<float>(1 - filter::box * filter::u));
  const Real more(static_cast<float>(1 + filter::box * filter::u));
  return {near, filter_max(far * less, far * more) < filter_min(near * less, near * more)};
}

/// The node or the leaf that a child is.
BOULE_INLINE const void* block_of(const GeometryView& geometry, std::uint32_t child) {
  if ((child & leaf_bit) == 0) return geometry.bvh.nodes + child;
  return geometry.spheres.blocks + geometry.spheres.scanned / bvh_leaf_size + place_of(child);
}

/// Asks for 256 bytes.
BOULE_INLINE void prefetch_lines(const char* begin) {
  __builtin_prefetch(begin);
  __builtin_prefetch(begin + 64);
  __builtin_prefetch(begin + 128);
  __builtin_prefetch(begin + 192);
}

/// Asks for what a child's visit will read: a large tree is not in the cache.
BOULE_INLINE void prefetch_block(const void* block, bool leaf) {
  static_assert(sizeof(SphereBlock) == 256 && sizeof(BvhNode) == 512);
  const char* const begin = static_cast<const char*>(block);
  prefetch_lines(begin);
  if (!leaf) prefetch_lines(begin + 256);
}

/// A child to visit: where the first ray enters it.
struct Visit {
  float near;
  std::uint32_t child;
  std::uint32_t leaf_size;
};

/// Children that are to be visited, nearest on top.
class VisitStack {
 public:
  [[nodiscard]] bool empty() const { return count_ == 0; }
  Visit pop() { return visits_[--count_]; }
  /// Keeps what one node adds sorted; `base` is the count before its first child.
  void push(const Visit& visit, int base) {
    int place = count_++;
    for (; place > base && visits_[place - 1].near < visit.near; --place)
      visits_[place] = visits_[place - 1];
    visits_[place] = visit;
  }
  [[nodiscard]] int count() const { return count_; }

 private:
  Visit visits_[bvh_max_depth * (bvh_width - 1) + 1];
  int count_ = 0;
};

/// Where the first ray enters a box, of those that are not out; -inf if one cannot tell.
BOULE_INLINE float first_entry(const Entry& entry) {
  const Real never(static_cast<float>(no_hit)), unknown(-static_cast<float>(no_hit));
  const Real near = select(entry.near <= entry.near, entry.near, unknown);
  return least_lane(select(entry.out, never, near));
}

/// The children of a node that some ray of a packet enters.
BOULE_INLINE void visit_children(OneForAll, const BoxRays& rays, const BvhNode& node,
                                 const Real& limit, VisitStack& stack) {
  const int base = stack.count();
  for (int k = 0; k < node.size; ++k) {
    const Boxes box{{node.min_x[k], node.min_y[k], node.min_z[k]},
                    {node.max_x[k], node.max_y[k], node.max_z[k]}};
    const Entry entry = enter_boxes(rays, box, limit);
    if (bits(entry.out) != all_lanes)
      stack.push({first_entry(entry), node.child[k], node.leaf_size[k]}, base);
  }
}

/// The children of a node that one ray, the same in every lane, enters.
BOULE_INLINE void visit_children(OnePerLane, const BoxRays& rays, const BvhNode& node,
                                 const Real& limit, VisitStack& stack) {
  const int base = stack.count();
  for (int first = 0; first < node.size; first += width) {
    const auto step = static_cast<std::size_t>(first / width);
    const auto get = [&](const float* row) { return OnePerLane::get(row, step); };
    const Boxes boxes{{get(node.min_x), get(node.min_y), get(node.min_z)},
                      {get(node.max_x), get(node.max_y), get(node.max_z)}};
    const Entry entry = enter_boxes(rays, boxes, limit);
    const unsigned out = bits(entry.out);
    alignas(64) float near[width];
    store(near, entry.near);
    for (int lane = 0; lane < width && first + lane < node.size; ++lane) {
      if (((out >> lane) & 1U) != 0) continue;
      const int k = first + lane;
      const float at = near[lane] == near[lane] ? near[lane] : -static_cast<float>(no_hit);
      stack.push({at, node.child[k], node.leaf_size[k]}, base);
    }
  }
}

/// Nothing beyond this is of interest: of W rays the farthest limit, of one ray, which all lanes
/// search for, the nearest. inf where that is not known.
template <class Access>
BOULE_INLINE float limit_of_all(const Real& limit) {
  if (bits(limit <= limit) != all_lanes) return static_cast<float>(no_hit);
  return Access::one_ray ? least_lane(limit) : greatest_lane(limit);
}

/// Returns how many nodes and leaves were visited.
template <Solver solver, class Access, bool origins_exact, class Best>
BOULE_INLINE std::size_t traverse_spheres(const RayLanes& rays, const GeometryView& geometry,
                                          Best& best) {
  if (geometry.bvh.size == 0) return 0;
  std::size_t visits = 0;
  const BoxRays box_rays(rays.filter);
  VisitStack stack;
  stack.push({-static_cast<float>(no_hit), 0, 0}, 0);
  float limit = limit_of_all<Access>(best.limit());
  while (!stack.empty() && !best.done()) {
    const Visit visit = stack.pop();
    const float slack = static_cast<float>(filter::box * filter::u);
    const float size = visit.near < 0 ? -visit.near : visit.near;
    if (limit < visit.near - size * slack) continue;
    ++visits;
    if (visit.leaf_size == 0) {
      // One ray: what one lane has found ends the search of all.
      const Real reach = Access::one_ray ? Real(limit) : best.limit();
      visit_children(Access{}, box_rays, geometry.bvh.nodes[visit.child], reach, stack);
      continue;
    }
    const LeafSpheres<Access> leaf(geometry.spheres, place_of(visit.child), visit.leaf_size);
    scan_steps<solver, origins_exact, bvh_leaf_size>(rays, geometry.spheres, leaf, 0,
                                                     Access::steps(visit.leaf_size), best);
    limit = limit_of_all<Access>(best.limit());
  }
  return visits;
}

/// All spheres, wherever they are.
template <Solver solver, class Access, bool origins_exact, class Best>
BOULE_INLINE std::size_t search_spheres(const RayLanes& rays, const GeometryView& geometry,
                                        Best& best) {
  scan_spheres<solver, Access, origins_exact>(rays, geometry.spheres, best);
  const std::size_t visits = traverse_spheres<solver, Access, origins_exact>(rays, geometry, best);
  best.settle(geometry.spheres, rays);
  return visits;
}

/// All primitives against these rays. Returns how many nodes and leaves were visited.
template <Solver solver, class Access, class Best>
BOULE_NOINLINE std::size_t search(const RayLanes& rays, const GeometryView& geometry, Best& best) {
  const std::size_t visits = rays.filter.origins_exact
                                 ? search_spheres<solver, Access, true>(rays, geometry, best)
                                 : search_spheres<solver, Access, false>(rays, geometry, best);
  scan_planes<solver, Access>(rays, geometry.planes, best);
  return visits;
}

}  // namespace boule::BOULE_KERNEL_ISA
