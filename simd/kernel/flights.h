#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/kernel/flight.h"

/// Rays that have nothing in common, sixteen in flight at a time: every round each takes a step,
/// and asks for the memory of its next one. A ray that is done makes room for the next of the
/// stream. Which is where when is a question of time only.
namespace boule::BOULE_KERNEL_ISA {

inline constexpr std::size_t most_flights = 16;

/// A hit among the nearest ones so far.
BOULE_INLINE void answer(const HitStream& hits, std::size_t ray, double t, std::int32_t id) {
  const bool nearer = t < hits.t[ray] || (t == hits.t[ray] && id < hits.id[ray]);
  if (!nearer) return;
  hits.t[ray] = t;
  hits.id[ray] = id;
}
BOULE_INLINE void answer(std::uint8_t* occluded, std::size_t ray, double, std::int32_t) {
  occluded[ray] = 1;
}

/// Rays and spheres that wait for their double solve, W pairs at a time.
template <class Answers>
class PairQueue {
 public:
  PairQueue(const RayStream& rays, const SphereView& spheres, const Answers& answers)
      : rays_(rays), spheres_(spheres), answers_(answers) {}

  BOULE_INLINE void add(std::uint32_t ray, std::uint32_t slot) {
    ray_[size_] = ray;
    slot_[size_++] = slot;
    if (size_ == lanes) solve();
  }
  /// Solves what waits.
  BOULE_NOINLINE void solve() {
    if (size_ == 0) return;
    alignas(64) float slots[lanes];
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::size_t from = k < size_ ? k : 0;
      gathered_.set(k, rays_, ray_[from]);
      slots[k] = std::bit_cast<float>(slot_[from]);
    }
    const SphereLanes spheres = gather_spheres(spheres_, load(slots));
    const Roots roots = solve_robust(load_exact(gathered_.view(lanes), 0), spheres);
    alignas(64) double t[lanes], id[lanes];
    store(t, roots.t);
    store(id, spheres.id);
    const unsigned hit = bits(roots.hit);
    for (std::size_t k = 0; k < size_; ++k) {
      if ((hit >> k & 1U) != 0) answer(answers_, ray_[k], t[k], static_cast<std::int32_t>(id[k]));
    }
    size_ = 0;
  }

 private:
  const RayStream& rays_;
  const SphereView& spheres_;
  const Answers answers_;
  GatheredRays<lanes> gathered_;
  std::uint32_t ray_[lanes], slot_[lanes];
  std::size_t size_ = 0;
};

/// W rays that are ready to start, each as FlightRay has it.
class Departures {
 public:
  BOULE_INLINE void set(const RayLanes& lanes_of_rays, const Real& reach, float extent) {
    const FilterRays& rays = lanes_of_rays.filter;
    const Vec3<Wide>& org = lanes_of_rays.exact.org;
    const Real farthest = abs(rays.org.x) + abs(rays.org.y) + abs(rays.org.z) + Real(extent);
    const FlightSlab x(org.x, rays.unit.x, farthest), y(org.y, rays.unit.y, farthest),
        z(org.z, rays.unit.z, farthest);
    store_rows(row_[0][0], {x.inverse, y.inverse, z.inverse, reach});
    store_rows(row_[1][0], {x.near, y.near, z.near, rays.live_from});
    store_rows(row_[2][0], {x.far, y.far, z.far, rays.live_to});
    store_rows(row_[3][0], {rays.org.x, rays.org.y, rays.org.z, rays.origin_error});
    store_rows(row_[4][0], {rays.h.x, rays.h.y, rays.h.z, rays.h.z});
    store_rows(row_[5][0], {rays.unit.x, rays.unit.y, rays.unit.z, rays.dead_below});
  }
  BOULE_INLINE void get(std::size_t lane, FlightRay& ray) const {
    constexpr std::size_t size = sizeof row_[0][0];
    static_assert(sizeof(FlightRay) == FlightRay::rows * size);
    for (std::size_t row = 0; row < FlightRay::rows; ++row)
      __builtin_memcpy(reinterpret_cast<char*>(&ray) + row * size, row_[row][lane], size);
  }

 private:
  alignas(64) float row_[FlightRay::rows][lanes][4];
};

/// The farthest that a tree goes from the world's origin along an axis.
BOULE_INLINE float extent_of(const BvhNode& root) {
  const float* const rows[] = {root.min_x, root.min_y, root.min_z,
                               root.max_x, root.max_y, root.max_z};
  Real extent(0.0F);
  for (std::size_t part = 0; part < parts_of_eight; ++part) {
    for (const float* row : rows) {
      const Real size = abs(load_of_eight(row, part));
      extent = filter_max(extent, select(size < Real(static_cast<float>(no_hit)), size, extent));
    }
  }
  return greatest_lane(extent);
}

/// Rays begin .. end - 1 of a stream, begin a multiple of W. Answers: HitStream for nearest hits,
/// std::uint8_t* for any.
template <class Answers>
class Flights {
 public:
  static constexpr bool any = !std::is_same_v<Answers, HitStream>;

  Flights(const GeometryView& geometry, const PaddedStream& stream, const Answers& answers)
      : geometry_(geometry),
        stream_(stream),
        answers_(answers),
        extent_(extent_of(geometry.bvh.nodes[0])),
        pairs_(stream.rays(), geometry.spheres, answers) {}

  /// Returns how many steps were taken, or what took as long.
  std::size_t run(std::size_t begin, std::size_t end) {
    std::size_t steps = 0;
    extra_steps_ = 0;
    first_ = begin;
    departed_ = ready_ = 0;
    end_ = end;
    for (Flight& flight : flights_) {
      if (depart(flight)) at_node_[node_count_++] = &flight;
    }
    for (; node_count_ + leaf_count_ > 0; round()) steps += node_count_ + leaf_count_;
    pairs_.solve();
    return steps + extra_steps_;
  }

 private:
  BOULE_INLINE void round() {
    Flight* moved[most_flights];
    const std::size_t nodes = node_count_, count = nodes + leaf_count_;
    for (std::size_t k = 0; k < nodes; ++k) moved[k] = at_node_[k];
    for (std::size_t k = nodes; k < count; ++k) moved[k] = at_leaf_[k - nodes];
    node_count_ = leaf_count_ = 0;
    for (std::size_t k = 0; k < nodes; ++k) moved[k]->visit_node();
    for (std::size_t k = nodes; k < count; ++k) visit_leaf(*moved[k]);
    // Only now: what was just stored in pieces cannot be loaded as a whole at once.
    for (std::size_t k = 0; k < count; ++k) go_on(*moved[k]);
  }

  /// Finds a flight's next step; a ray that has none makes room for another.
  BOULE_INLINE void go_on(Flight& flight) {
    std::uint32_t child = 0;
    if (!flight.pending.pop(flight.ray.reach, child)) {
      land(flight);
      if (!depart(flight)) return;
      at_node_[node_count_++] = &flight;
      return;
    }
    const bool leaf = (child & leaf_bit) != 0;
    flight.next = block_of(geometry_, child);
    prefetch_block(flight.next, leaf);
    at_node_[node_count_] = &flight;
    at_leaf_[leaf_count_] = &flight;
    node_count_ += leaf ? 0 : 1;
    leaf_count_ += leaf ? 1 : 0;
  }

  /// W rays more: what is in no tree is met at once, by all of them together.
  BOULE_NOINLINE bool prepare() {
    first_ += ready_;
    departed_ = ready_ = 0;
    if (first_ >= end_) return false;
    ready_ = stream_.live(first_);
    const PacketPlace place = stream_.packet(first_);
    const RayLanes rays = load_packet(*place.rays, place.first);
    if constexpr (any) {
      AnyHit<false> best(rays);
      meet_scanned(rays, best);
      for (std::size_t lane = 0; lane < ready_; ++lane)
        answers_[first_ + lane] = static_cast<std::uint8_t>(best.hit >> lane & 1U);
      departures_.set(rays, best.far, extent_);
    } else {
      ClosestHit best(rays);
      meet_scanned(rays, best);
      store_packet(best, answers_, first_, ready_);
      departures_.set(rays, best.reach, extent_);
    }
    return true;
  }
  template <class Best>
  BOULE_INLINE void meet_scanned(const RayLanes& rays, Best& best) {
    if (rays.filter.origins_exact) {
      scan_spheres<Solver::robust, OneForAll, true>(rays, geometry_.spheres, best);
    } else {
      scan_spheres<Solver::robust, OneForAll, false>(rays, geometry_.spheres, best);
    }
    best.settle(geometry_.spheres, rays);
    scan_planes<Solver::robust, OneForAll>(rays, geometry_.planes, best);
  }

  /// Starts the next ray that has somewhere to go; false if there is none.
  BOULE_INLINE bool depart(Flight& flight) {
    FlightRay& ray = flight.ray;
    for (;;) {
      if (departed_ == ready_ && !prepare()) return false;
      const std::size_t lane = departed_++;
      departures_.get(lane, ray);
      flight.index = static_cast<std::uint32_t>(first_ + lane);
      if constexpr (any) {
        if (answers_[flight.index] != 0) continue;
      }
      const bool judged = ray.unit[0] <= ray.unit[0] && !(ray.dead_below < 0);
      if (judged && 0 <= ray.reach) break;
      if (!judged) go_alone(flight.index);
    }
    flight.choose_rows();
    flight.source = stream_.rays().source[flight.index];
    flight.inside = stream_.rays().inside[flight.index] != 0;
    flight.next = geometry_.bvh.nodes;
    flight.pending.clear();
    flight.candidates.size = 0;
    return true;
  }
  /// A ray that floats cannot judge, or that looks behind its origin.
  BOULE_NOINLINE void go_alone(std::size_t index) {
    const RayLanes ray = load_single(stream_.rays(), index);
    if constexpr (any) {
      AnyHit<true> best(ray);
      extra_steps_ += search<Solver::robust, OnePerLane>(ray, geometry_, best);
      answers_[index] = best.hit != 0 ? 1 : 0;
    } else {
      ClosestHit best(ray);
      extra_steps_ += search<Solver::robust, OnePerLane>(ray, geometry_, best);
      store_single(best, answers_, index);
    }
  }

  BOULE_INLINE void visit_leaf(Flight& flight) {
    const auto& leaf = *static_cast<const SphereBlock*>(flight.next);
    const FilterRays rays = flight.ray.filter();
    for (std::size_t part = 0; part < parts_of_eight; ++part) {
      const auto get = [&](const float* row) { return load_of_eight(row, part); };
      const Vec3<Real> center{get(leaf.center_x), get(leaf.center_y), get(leaf.center_z)};
      const Real r = get(leaf.radius);
      const RealMask misses = rejected_on_the_spot<false>(rays, center, r);
      unsigned in = bits(~misses & (r <= r)) & part_lanes;  // where there is no sphere r is NaN
      if (in == 0) continue;
      const auto first = static_cast<std::uint32_t>(
          static_cast<std::size_t>(&leaf - geometry_.spheres.blocks) * bvh_leaf_size +
          part * lanes);
      if (flight.source >= 0) in = without_source(flight, first, in);
      if (in != 0) meet(flight, rays, {center, r, first, in});
    }
  }
  /// The sphere that a ray leaves is met again only from the inside, and only double tells where.
  BOULE_INLINE unsigned without_source(Flight& flight, std::uint32_t first, unsigned in) {
    for (unsigned rest = in; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(rest));
      if (geometry_.spheres.id[first + lane] != flight.source) continue;
      if (flight.inside) add_candidate(flight, -static_cast<float>(no_hit), first + lane);
      return in & ~(1U << lane);
    }
    return in;
  }

  /// Spheres in lanes: slots first .. first + W - 1, of which `in` may be met.
  struct Survivors {
    Vec3<Real> center;
    Real radius;
    std::uint32_t first;
    unsigned in;
  };
  BOULE_INLINE void meet(Flight& flight, const FilterRays& rays, const Survivors& spheres) {
    const RootBounds roots = bound_roots(rays, spheres.center, spheres.radius);
    const Real low = lowest(roots, rays);
    unsigned in = spheres.in & ~bits(dead(roots, rays) | (Real(flight.ray.reach) < low));
    if (in == 0) return;
    alignas(64) float value[width];
    if constexpr (any) {
      if ((bits(live(roots, rays)) & in) != 0) {
        answers_[flight.index] = 1;
        flight.pending.clear();
        flight.candidates.size = 0;
        return;
      }
    } else {
      store(value, highest(roots, rays));
      for (unsigned rest = in; rest != 0; rest &= rest - 1) {
        const float high = value[std::countr_zero(rest)];
        if (high < flight.ray.reach) flight.ray.reach = high;
      }
    }
    store(value, low);
    for (; in != 0; in &= in - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(in));
      if (!(flight.ray.reach < value[lane]))
        add_candidate(flight, value[lane], spheres.first + lane);
    }
  }

  BOULE_INLINE void add_candidate(Flight& flight, float low, std::uint32_t slot) {
    if (flight.candidates.size == FlightCandidates::capacity) make_room(flight);
    flight.candidates.add(low, slot);
  }
  /// Where floats are certain of nothing, only solved hits can end the way: all at once, early.
  BOULE_NOINLINE void make_room(Flight& flight) {
    FlightCandidates& candidates = flight.candidates;
    candidates.drop_beyond(flight.ray.reach);
    if (candidates.size < FlightCandidates::capacity) return;
    const RayLanes ray = load_single(stream_.rays(), flight.index);
    for (unsigned first = 0; first < candidates.size; first += lanes) {
      alignas(64) float slots[lanes];
      for (unsigned k = 0; k < lanes; ++k) {
        const unsigned from = first + k < candidates.size ? first + k : first;
        slots[k] = std::bit_cast<float>(candidates.slot[from]);
      }
      const SphereLanes spheres = gather_spheres(geometry_.spheres, load(slots));
      take(flight, ray, solve_robust(ray.exact, spheres), spheres.id);
    }
    candidates.size = 0;
    extra_steps_ += FlightCandidates::capacity / 2;
  }
  /// Hits of one ray: nothing beyond them is of interest any more.
  BOULE_INLINE void take(Flight& flight, const RayLanes& ray, const Roots& roots, const Wide& ids) {
    alignas(64) double t[lanes], id[lanes];
    alignas(64) float reach[lanes];
    store(t, roots.t);
    store(id, ids);
    store(reach, ClosestHit::distance(roots.t, ray));
    for (unsigned hit = bits(roots.hit); hit != 0; hit &= hit - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(hit));
      answer(answers_, flight.index, t[k], static_cast<std::int32_t>(id[k]));
      if (reach[k] < flight.ray.reach) flight.ray.reach = reach[k];
      if constexpr (any) flight.pending.clear();
    }
  }
  /// Leaves the candidates to double.
  BOULE_INLINE void land(Flight& flight) {
    FlightCandidates& candidates = flight.candidates;
    for (unsigned k = 0; k < candidates.size; ++k) {
      if (!(flight.ray.reach < candidates.low[k])) pairs_.add(flight.index, candidates.slot[k]);
    }
    candidates.size = 0;
  }

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const Answers answers_;
  float extent_;
  PairQueue<Answers> pairs_;

  /// Rays first_ + departed_ .. first_ + ready_ - 1 are ready to start.
  Departures departures_;
  std::size_t first_ = 0, departed_ = 0, ready_ = 0, end_ = 0;
  std::size_t extra_steps_ = 0;

  Flight flights_[most_flights];
  /// Those whose next step is a node, or a leaf; the last place is for one that is not one of them.
  Flight *at_node_[most_flights + 1], *at_leaf_[most_flights + 1];
  std::size_t node_count_ = 0, leaf_count_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
