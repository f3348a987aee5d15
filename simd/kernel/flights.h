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

  /// Those of a ray's candidates that do not begin beyond `reach`.
  BOULE_INLINE void add(std::uint32_t ray, const FlightCandidates& candidates, float reach) {
    unsigned first = 0;
    do {  // once, for nearly every ray
      const unsigned chosen = candidates.before(reach, first);
      store_chosen(slot_ + size_, load(candidates.slot + first), chosen);
      store_anywhere(ray_ + size_, Real(std::bit_cast<float>(ray)));
      size_ += static_cast<std::size_t>(std::popcount(chosen));
      if (size_ >= lanes) {
        solve(lanes);
        size_ -= lanes;
        store(slot_, load(slot_ + lanes));
        store(ray_, load(ray_ + lanes));
      }
      first += lanes;
    } while (first < candidates.size);
  }
  /// Solves what waits.
  BOULE_INLINE void finish() {
    if (size_ > 0) solve(size_);
    size_ = 0;
  }

 private:
  /// Solves the first `count` pairs, at most W.
  BOULE_NOINLINE void solve(std::size_t count) {
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::size_t from = k < count ? k : 0;
      gathered_.set(k, rays_, std::bit_cast<std::uint32_t>(ray_[from]));
      slot_[k] = slot_[from];
    }
    const SphereLanes spheres = gather_spheres(spheres_, load(slot_));
    const Roots roots = solve_robust(load_exact(gathered_.view(lanes), 0), spheres);
    alignas(64) double t[lanes], id[lanes];
    store(t, roots.t);
    store(id, spheres.id);
    const unsigned hit = bits(roots.hit);
    for (std::size_t k = 0; k < count; ++k) {
      if ((hit >> k & 1U) == 0) continue;
      answer(answers_, std::bit_cast<std::uint32_t>(ray_[k]), t[k],
             static_cast<std::int32_t>(id[k]));
    }
  }

  const RayStream& rays_;
  const SphereView& spheres_;
  const Answers answers_;
  GatheredRays<lanes> gathered_;
  alignas(64) float ray_[2 * lanes], slot_[2 * lanes];  ///< bits
  std::size_t size_ = 0;
};

/// W rays that are ready to start, each as FlightRay has it.
class Departures {
 public:
  BOULE_INLINE void set(const RayLanes& lanes_of_rays, const Real& reach, float extent) {
    const FilterRays& rays = lanes_of_rays.filter;
    const auto [x, y, z] = slabs_of(lanes_of_rays, extent);
    store_rows(row_[0][0], {x.inverse, y.inverse, z.inverse, reach});
    store_rows(row_[1][0], {x.near, y.near, z.near, rays.live_from});
    store_rows(row_[2][0], {x.far, y.far, z.far, rays.live_to});
    store_rows(row_[3][0], {rays.org.x, rays.org.y, rays.org.z, rays.origin_error});
    store_rows(row_[4][0], {rays.unit.x, rays.unit.y, rays.unit.z, rays.unit.z});
    const Real zero(0.0F);
    judged_ = bits((rays.unit.x <= rays.unit.x) & (zero <= rays.dead_below));
    open_ = bits(zero <= reach);
  }
  BOULE_INLINE void get(std::size_t lane, FlightRay& ray) const {
    static_assert(sizeof(FlightRay) == FlightRay::rows * sizeof row_[0][0]);
    get_row<0>(lane, ray);
    get_row<1>(lane, ray);
    get_row<2>(lane, ray);
    get_row<3>(lane, ray);
    get_row<4>(lane, ray);
  }
  /// Whether floats can judge a ray, which does not look behind its origin.
  [[nodiscard]] BOULE_INLINE bool judged(std::size_t lane) const {
    return (judged_ >> lane & 1U) != 0;
  }
  /// Whether there is anything to be found.
  [[nodiscard]] BOULE_INLINE bool open(std::size_t lane) const { return (open_ >> lane & 1U) != 0; }

 private:
  template <std::size_t row>
  BOULE_INLINE void get_row(std::size_t lane, FlightRay& ray) const {
    constexpr std::size_t size = sizeof row_[row][0];
    __builtin_memcpy(reinterpret_cast<char*>(&ray) + row * size, row_[row][lane], size);
  }

  unsigned judged_ = 0, open_ = 0;
  alignas(64) float row_[FlightRay::rows][lanes][4];
};

/// Rays begin .. end - 1 of a stream, begin a multiple of W. Answers: HitStream for nearest hits,
/// std::uint8_t* for any.
template <class Answers>
class Flights {
 public:
  static constexpr bool seeks_any = !std::is_same_v<Answers, HitStream>;
  using Flight =
      boule::BOULE_KERNEL_ISA::Flight<std::conditional_t<seeks_any, PendingStack, PendingNearest>>;

  Flights(const GeometryView& geometry, const PaddedStream& stream, const Answers& answers)
      : geometry_(geometry),
        stream_(stream),
        answers_(answers),
        blocks_(geometry),
        pairs_(stream.rays(), geometry.spheres, answers) {}

  /// Returns how many steps were taken, or what took as long.
  std::size_t run(std::size_t begin, std::size_t end) {
    std::size_t steps = 0;
    extra_steps_ = 0;
    first_ = begin;
    departed_ = ready_ = 0;
    end_ = end;
    for (Flight& flight : flights_) {
      if (!depart(flight)) break;
      flying_[count_++] = at_node_[node_count_++] = &flight;
    }
    for (; count_ > 0; round()) steps += count_;
    pairs_.finish();
    return steps + extra_steps_;
  }

 private:
  BOULE_INLINE void round() {
    for (std::size_t k = 0; k < node_count_; ++k) at_node_[k]->visit_node();
    for (std::size_t k = 0; k < leaf_count_; ++k) visit_leaf(*at_leaf_[k]);
    // Only now: what was just stored in pieces cannot be loaded as a whole at once.
    node_count_ = leaf_count_ = 0;
    for (std::size_t k = 0; k < count_;) {
      if (go_on(*flying_[k])) {
        ++k;
      } else {
        flying_[k] = flying_[--count_];
      }
    }
  }

  /// Finds a flight's next step; a ray that has none makes room for another. False if there is
  /// none.
  BOULE_INLINE bool go_on(Flight& flight) {
    std::uint32_t child = 0;
    if (!flight.pending.pop(flight.ray.reach, child)) {
      pairs_.add(flight.index, flight.candidates, flight.ray.reach);
      if (!depart(flight)) return false;
      at_node_[node_count_++] = &flight;
      return true;
    }
    flight.next = blocks_.fetch(child);
    const std::size_t leaf = child >> 31;  // no branch here, either
    at_node_[node_count_] = at_leaf_[leaf_count_] = &flight;
    node_count_ += 1 - leaf;
    leaf_count_ += leaf;
    return true;
  }

  /// W rays more: what is in no tree is met at once, by all of them together.
  BOULE_NOINLINE bool prepare() {
    first_ += ready_;
    departed_ = ready_ = 0;
    if (first_ >= end_) return false;
    ready_ = stream_.live(first_);
    const PacketPlace place = stream_.packet(first_);
    const RayLanes rays = load_packet(*place.rays, place.first);
    if constexpr (seeks_any) {
      AnyHit<false> best(rays);
      meet_scanned(rays, best);
      for (std::size_t lane = 0; lane < ready_; ++lane)
        answers_[first_ + lane] = static_cast<std::uint8_t>(best.hit >> lane & 1U);
      departures_.set(rays, best.far, geometry_.bvh.extent);
    } else {
      ClosestHit best(rays);
      meet_scanned(rays, best);
      store_packet(best, answers_, first_, ready_);
      departures_.set(rays, best.reach, geometry_.bvh.extent);
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
    for (;;) {
      if (departed_ == ready_ && !prepare()) return false;
      const std::size_t lane = departed_++;
      flight.index = static_cast<std::uint32_t>(first_ + lane);
      if constexpr (seeks_any) {
        if (answers_[flight.index] != 0) continue;
      }
      if (!departures_.judged(lane)) {
        go_alone(flight.index);
      } else if (departures_.open(lane)) {
        departures_.get(lane, flight.ray);
        break;
      }
    }
    flight.choose_rows();
    flight.source = stream_.rays().source[flight.index];
    flight.inside = stream_.rays().inside[flight.index] != 0;
    flight.candidates.size = 0;
    flight.next = geometry_.bvh.nodes;
    return true;
  }
  /// A ray that floats cannot judge, or that looks behind its origin.
  BOULE_NOINLINE void go_alone(std::size_t index) {
    const RayLanes ray = load_single(stream_.rays(), index);
    if constexpr (seeks_any) {
      AnyHit<true> best(ray);
      extra_steps_ += search<Solver::robust, OnePerLane>(ray, geometry_, best);
      answers_[index] = best.hit != 0 ? 1 : 0;
    } else {
      ClosestHit best(ray);
      extra_steps_ += search<Solver::robust, OnePerLane>(ray, geometry_, best);
      store_single(best, answers_, index);
    }
  }

  /// A step: the spheres of a leaf that may be hit become candidates.
  BOULE_INLINE void visit_leaf(Flight& flight) {
    const auto& leaf = *static_cast<const SphereBlock*>(flight.next);
    const auto slot = static_cast<std::uint32_t>(&leaf - geometry_.spheres.blocks) *
                      static_cast<std::uint32_t>(bvh_leaf_size);
    const FilterRays rays = flight.ray.filter();
    const Real reach(flight.ray.reach), none(static_cast<float>(no_hit));
    Real least = reach;
    for (std::uint32_t at = 0; at < bvh_leaf_size; at += lanes) {
      const Vec3<Real> center{load(leaf.center_x + at), load(leaf.center_y + at),
                              load(leaf.center_z + at)};
      const RealMask own = source_in(flight, slot + at);
      const NextRoots roots(find_approach(rays, center, load(leaf.radius + at)), rays, reach, own);
      if constexpr (seeks_any) {
        if (any(roots.sure & (roots.high <= rays.live_to))) {
          answers_[flight.index] = 1;
          flight.pending.clear();
          flight.candidates.size = 0;
          return;
        }
      } else {
        least = lesser_or(select(roots.sure, roots.high, none), least);
      }
      flight.candidates.add(roots.low, count_from(slot + at), bits(roots.in));
    }
    if constexpr (!seeks_any) flight.ray.reach = least_lane(least);
    if (flight.candidates.size > FlightCandidates::most) make_room(flight);
  }
  /// The lane of the sphere that a ray leaves: it is met again only from the inside, and only
  /// double tells where.
  BOULE_INLINE RealMask source_in(Flight& flight, std::uint32_t slot) {
    const RealMask source = equal(geometry_.spheres.id + slot, flight.source);
    if (flight.inside && any(source)) {
      flight.candidates.add(Real(-static_cast<float>(no_hit)), count_from(slot), bits(source));
    }
    return source;
  }

  /// Where floats are certain of nothing, only solved hits can end the way: all at once, early.
  BOULE_NOINLINE void make_room(Flight& flight) {
    FlightCandidates& candidates = flight.candidates;
    candidates.drop_beyond(flight.ray.reach);
    if (candidates.size <= FlightCandidates::most) return;
    const RayLanes ray = load_single(stream_.rays(), flight.index);
    for (unsigned first = 0; first < candidates.size; first += lanes) {
      for (unsigned k = candidates.size; k < first + lanes; ++k)
        candidates.slot[k] = candidates.slot[first];
      const SphereLanes spheres = gather_spheres(geometry_.spheres, load(candidates.slot + first));
      take(flight, ray, solve_robust(ray.exact, spheres), spheres.id);
    }
    extra_steps_ += candidates.size / 2;
    candidates.size = 0;
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
      if constexpr (seeks_any) flight.pending.clear();
    }
  }

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const Answers answers_;
  TreeBlocks blocks_;
  PairQueue<Answers> pairs_;

  /// Rays first_ + departed_ .. first_ + ready_ - 1 are ready to start.
  Departures departures_;
  std::size_t first_ = 0, departed_ = 0, ready_ = 0, end_ = 0;
  std::size_t extra_steps_ = 0;

  Flight flights_[most_flights];
  Flight* flying_[most_flights];
  std::size_t count_ = 0;
  /// Those whose next step is a node, or a leaf; the last place is for one that is not one of them.
  Flight *at_node_[most_flights + 1], *at_leaf_[most_flights + 1];
  std::size_t node_count_ = 0, leaf_count_ = 0;
};

}  // namespace boule::BOULE_KERNEL_ISA
