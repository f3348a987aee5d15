// The chords of single rays: all that a ray passes through, not only the first.
#include <bit>

#include "simd/kernel/search/packet/capsule_search.h"
#include "simd/kernel/search/packet/chord_list.h"
#include "simd/kernel/search/packet/lone_ray.h"
#include "simd/kernel/search/packet/parts.h"
#include "simd/kernel/search/packet/traverse.h"

namespace boule::BOULE_KERNEL_ISA {
namespace {

/// The chords of one ray, which all lanes hold. It takes the place of the nearest hit in the
/// search: it wants every sphere before the end of the ray.
class AllChords {
 public:
  /// Adds chords behind the first `count`.
  BOULE_INLINE AllChords(const ChordStream& to, std::size_t count) : to_(to), count_(count) {}
  /// Sets the end of the search, before a search by lanes.
  BOULE_INLINE void end_with(const RayLanes& rays) {
    far_ = ClosestHit::distance(rays.exact.tmax, rays);
  }

  [[nodiscard]] BOULE_INLINE Real limit() const { return far_; }
  /// Whether there were more chords than the stream has room for.
  [[nodiscard]] bool done() const { return count_ > to_.capacity; }
  static constexpr unsigned open(unsigned lanes) { return lanes; }
  template <class Spheres>
  static void settle(const Spheres& /*all*/, const RayLanes& /*rays*/) {}
  static constexpr bool ordered = false;
  static constexpr std::size_t chunk = tuning::any_chunk;

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Capsules before the end of the ray.
  [[nodiscard]] BOULE_INLINE bool wants(const Real& low, unsigned out) const {
    return (bits(far_ < low) | out) != all_lanes;
  }
  BOULE_INLINE void consider(const RayLanes& rays, const CapsuleLanes& capsule,
                             const CapsuleBounds& /*bounds*/, const Bits& slot, unsigned /*out*/) {
    const CapsuleRoots line = meet_lines(rays.exact, capsule);
    add(rays.exact, line.enter, line.leave, line.met, capsule.id, slot);
  }

  /// Adds the chords of the lanes that are `met` and have a part between tmin and tmax.
  BOULE_INLINE void add(const ExactRays& rays, const Wide& enter, const Wide& leave,
                        const WideMask& met, const Bits& id, const Bits& slot) {
    unsigned lanes = bits(narrow(met & (rays.tmin < leave) & (enter <= rays.tmax)));
    if (lanes == 0) return;
    alignas(64) double enters[width], leaves[width];
    alignas(64) std::int32_t ids[width];
    alignas(64) std::uint32_t slots[width];
    store(enters, enter);
    store(leaves, leave);
    store(ids, id);
    store(slots, slot);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      if (add(enters[lane], leaves[lane], ids[lane], slots[lane])) return;
    }
  }
  /// Adds a chord. Returns true if there is no room for it.
  BOULE_INLINE bool add(double enter, double leave, std::int32_t id, std::uint32_t slot) {
    if (count_ >= to_.capacity) {
      count_ = to_.capacity + 1;
      return true;
    }
    to_.enter[count_] = enter;
    to_.leave[count_] = leave;
    to_.id[count_] = id;
    to_.slot[count_] = slot;
    ++count_;
    return false;
  }

 private:
  const ChordStream& to_;
  std::size_t count_;
  Real far_;
};

/// One ray during traversal, whose children may be visited in any order.
class ChordWalk {
 public:
  BOULE_INLINE ChordWalk(const RayLanes& rays, float extent)
      : single_(rays, extent), box_rays_(rays, extent) {}

  BOULE_INLINE void visit_children(const BvhNode& node, unsigned /*lanes*/, const Real& /*limit*/,
                                   float limit, VisitStack& stack) const {
    for (int first = 0; first < node.size; first += width) {
      const auto get = [&](const float* row) { return load(row + first); };
      const Boxes boxes{{get(node.min_x), get(node.min_y), get(node.min_z)},
                        {get(node.max_x), get(node.max_y), get(node.max_z)}};
      const Entry entry = enter_boxes(box_rays_, boxes, Real(limit));
      const unsigned there = (1U << (node.size - first < width ? node.size - first : width)) - 1;
      for (unsigned in = there & ~bits(entry.out); in != 0; in &= in - 1) {
        const int k = first + std::countr_zero(in);
        stack.push_if(true, {-static_cast<float>(no_hit), node.child[k], node.leaf_size[k]});
      }
    }
  }
  BOULE_INLINE void list_survivors(const LeafSpheres<OnePerLane>& leaf, unsigned lanes,
                                   const Real& limits, float limit,
                                   Survivors<bvh_leaf_size>& survivors) const {
    single_.list_survivors(leaf, lanes, limits, limit, survivors);
  }

 private:
  SingleWalk single_;
  BoxRays box_rays_;
};

template <class Access, class Search>
BOULE_INLINE std::size_t with_walk(const RayLanes& rays, const AllChords& /*best*/,
                                   const BvhView& bvh, const Search& search) {
  ChordWalk walk(rays, bvh.extent);
  return search(walk);
}

/// As traverse_tree() elsewhere, but every child will be visited: its memory is fetched at once.
template <class Access, class Walk, class Tree, class All>
BOULE_INLINE std::size_t traverse_tree(const RayLanes& rays, Solver solver, Walk& walk,
                                       const Tree& tree, const All& all, AllChords& best) {
  std::size_t visits = 0;
  VisitStack stack;
  stack.push_if(true, {-static_cast<float>(no_hit), 0, 0});
  float limit = limit_of_all<Access>(best.limit());
  for (; !stack.empty() && !best.done(); ++visits) {
    const Visit visit = stack.pop();
    if (visit.leaf_size != 0) {
      meet_leaf<Access>(rays, solver, walk, all, tree.leaf(visit.child), visit.leaf_size, all_lanes,
                        limit, best);
      continue;
    }
    const int before = stack.count();
    walk.visit_children(tree.node(visit.child), all_lanes, best.limit(), limit, stack);
    for (int at = stack.count() - 1; at >= before; --at) tree.fetch(stack.child(at));
  }
  return visits;
}

/// In place of the scan's functions of the same names, which keep the nearest hit.
template <class All, class Spheres, std::size_t capacity>
BOULE_INLINE void meet_survivors(const RayLanes& rays, Solver /*solver*/, const All& /*all*/,
                                 const Spheres& spheres, std::size_t begin,
                                 const Survivors<capacity>& survivors, AllChords& best) {
  const ExactRays& exact = rays.exact;
  for (std::size_t k = 0; k < survivors.count; ++k) {
    const std::size_t step = begin + survivors.offset[k];
    const SphereLanes sphere = get_sphere(spheres, step);
    LineRoots line = meet_lines(exact, sphere);
    WideMask met = Wide(0.0) <= line.discriminant;
    if (exact.has_source) {  // as in solve_robust()
      const WideMask leaves = widen(exact.source == sphere.id);
      const Wide across = (line.b + line.b) * exact.inverse_a;
      line.enter = select(leaves, Wide(-no_hit), line.enter);
      line.leave = select(leaves, across, line.leave);
      met = (leaves & exact.inside & (line.r == line.r)) | (~leaves & met);
    }
    best.add(exact, line.enter, line.leave, met, sphere.id, spheres.slot(step));
  }
}
template <class Access>
BOULE_INLINE void scan_planes(const RayLanes& rays, Solver /*solver*/, const PlaneView& planes,
                              AllChords& best) {
  const std::size_t steps = Access::steps(planes.size);
  for (std::size_t step = 0; step < steps && !best.done(); ++step) {
    const PlaneLanes plane = get_plane<Access>(planes, step);
    const Roots roots = solve_robust(rays.exact, plane);
    const WideMask goes_in = exact_dot(rays.exact.dir, widen(plane.normal)) < Wide(0.0);
    best.add(rays.exact, select(goes_in, roots.t, Wide(-no_hit)),
             select(goes_in, Wide(no_hit), roots.t), roots.hit, plane.id, Bits(0));
  }
}

/// Finds the chords of single rays of a stream in the tree as LoneRays.
template <class Geometry>
class LoneRays {
 public:
  LoneRays(const GeometryView& geometry, const RayStream& rays)
      : geometry_(geometry), stream_(rays), suits_(LoneRay::suits(geometry)) {}

  /// Returns false if it cannot. Rays come in order.
  BOULE_INLINE bool list(const Ray& ray, std::size_t index, AllChords& all) {
    if (!suits_) return false;
    const std::size_t lane = index % width;
    if (index - lane != loaded_) {
      loaded_ = index - lane;
      packet_.load(stream_, loaded_, geometry_.bvh.extent);
    }
    LoneRay lone(geometry_, ray, packet_, lane);
    if (!lone.may()) return false;
    lone.find_chords(geometry_,
                     [&](double enter, double leave, std::int32_t id, std::uint32_t slot) {
                       return all.add(enter, leave, id, slot);
                     });
    return true;
  }

 private:
  const GeometryView& geometry_;
  PaddedStream stream_;
  bool suits_;
  LonePacket packet_;
  std::size_t loaded_ = static_cast<std::size_t>(-1);
};
template <>
class LoneRays<PartsGeometry> {
 public:
  LoneRays(const PartsGeometry&, const RayStream&) {}
  static bool list(const Ray&, std::size_t, AllChords&) { return false; }
};

/// The chords outside the tree of a geometry of one part.
BOULE_INLINE void list_others(const GeometryView& geometry, const RayLanes& rays, AllChords& all) {
  scan_spheres<OnePerLane>(rays, Solver::robust, geometry.spheres, all);
  scan_planes<OnePerLane>(rays, Solver::robust, geometry.planes, all);
}
BOULE_INLINE void list_others(const PartsGeometry&, const RayLanes&, AllChords&) {}

/// The chords of a ray.
template <class Geometry>
BOULE_INLINE void chords_of_ray(const Geometry& geometry, const CapsuleView& capsules,
                                const Ray& ray, std::size_t index, LoneRays<Geometry>& lone,
                                AllChords& all) {
  if (!(ray.tmin < ray.tmax)) return;
  const bool alone = lone.list(ray, index, all);
  if (alone && !LoneRay::leaves_others(geometry) && capsules.slots == 0) return;
  RayLanes lanes;
  load_single(ray, lanes);
  all.end_with(lanes);
  if (alone) {
    list_others(geometry, lanes, all);
  } else {
    search<OnePerLane>(lanes, Solver::robust, geometry, all);
  }
  if (capsules.slots != 0) search_capsules<OnePerLane>(lanes, capsules, all);
}

}  // namespace

template <class Geometry>
std::size_t list_chords(const Geometry& geometry, const CapsuleView& capsules,
                        const RayStream& rays, std::size_t first, const ChordStream& chords,
                        std::size_t* ends) {
  std::size_t count = 0;
  LoneRays<Geometry> lone(geometry, rays);
  for (std::size_t i = first; i < rays.size; ++i) {
    const Ray ray = get_ray(rays, i);
    AllChords all(chords, count);
    chords_of_ray(geometry, capsules, ray, i, lone, all);
    if (all.done()) return i;
    ends[i] = count = all.count();
  }
  return rays.size;
}

template std::size_t list_chords(const GeometryView&, const CapsuleView&, const RayStream&,
                                 std::size_t, const ChordStream&, std::size_t*);
template std::size_t list_chords(const PartsGeometry&, const CapsuleView&, const RayStream&,
                                 std::size_t, const ChordStream&, std::size_t*);

}  // namespace boule::BOULE_KERNEL_ISA
