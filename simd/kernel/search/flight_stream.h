#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/kernel/search/flight.h"

/// Rays that have nothing in common, many in flight at a time: every round twelve take a step,
/// and ask for the memory of their next one. A ray that is done makes room for the next of the
/// stream. Which is where when is a question of time only.
namespace boule::BOULE_KERNEL_ISA {

/// What a small tree's steps read need not be waited for. Fewer than 24 would leave rounds short.
inline constexpr std::size_t flights_nearby = 24, most_flights = 32;

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
    ExactRays rays;
    load_exact(gathered_.view(lanes), 0, rays);
    const Roots roots = solve_robust(rays, spheres);
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
    steps_ = 0;
    first_ = begin;
    departed_ = ready_ = 0;
    end_ = end;
    const std::size_t places = blocks_.is_far() ? most_flights : flights_nearby;
    for (std::size_t k = 0; k < places && depart(flights_[k]); ++k)
      waiting_[node].push(flights_[k]);
    while (round()) {
    }
    pairs_.finish();
    return steps_;
  }

 private:
  /// Steps taken together, at most.
  static constexpr std::size_t most_together = 12;

  /// What flights wait for: a node, a leaf, or another ray.
  enum Kind : std::size_t { node, leaf, departure, kinds };

  /// Flights whose next step is of one kind: first in, first out, for what a step reads to come.
  class Waiting {
   public:
    [[nodiscard]] BOULE_INLINE std::size_t size() const { return end_ - begin_; }
    /// `count`: 1, or 0 for one that does not wait here. No branch: which cannot be foretold.
    BOULE_INLINE void push(Flight& flight, std::size_t count = 1) {
      flights_[end_ % places] = &flight;
      end_ += count;
    }
    BOULE_INLINE Flight& pop() { return *flights_[begin_++ % places]; }

   private:
    static constexpr std::size_t places = 2 * most_flights;
    static_assert(std::has_single_bit(places));
    Flight* flights_[places];
    std::size_t begin_ = 0, end_ = 0;
  };

  /// Steps of the kind that most flights wait for; false if none waits.
  BOULE_INLINE bool round() {
    Kind kind = waiting_[node].size() < waiting_[leaf].size() ? leaf : node;
    if (waiting_[kind].size() < waiting_[departure].size()) kind = departure;
    const std::size_t size = waiting_[kind].size();
    if (size >= most_together) {
      step_together(kind, most_together);
    } else {
      step_together(kind, size);
    }
    return size > 0;
  }
  BOULE_INLINE void step_together(Kind kind, std::size_t count) {
    Flight* together[most_together];
    for (std::size_t k = 0; k < count; ++k) together[k] = &waiting_[kind].pop();
    if (kind == departure) {
      for (std::size_t k = 0; k < count; ++k) arrive(*together[k]);
      return;
    }
    if (kind == node) {
      for (std::size_t k = 0; k < count; ++k) together[k]->visit_node();
    } else {
      visit_leaves(together, count);
    }
    steps_ += count;
    // Only now: what was just stored in pieces cannot be loaded as a whole at once.
    for (std::size_t k = 0; k < count; ++k) go_on(*together[k]);
  }

  /// Finds a flight's next step. No branch: nothing can be foretold.
  BOULE_INLINE void go_on(Flight& flight) {
    std::uint32_t child = 0;
    const bool left = flight.pending.pop(flight.ray.reach, child);
    child &= 0U - static_cast<std::uint32_t>(left);
    flight.next = blocks_.fetch(child);
    const auto is_leaf = static_cast<std::size_t>(child >> 31),
               goes_on = static_cast<std::size_t>(left);
    waiting_[node].push(flight, goes_on - is_leaf);
    waiting_[leaf].push(flight, is_leaf);
    waiting_[departure].push(flight, 1 - goes_on);
  }
  /// A ray's way has come to its end: it makes room for another, if there is one.
  BOULE_INLINE void arrive(Flight& flight) {
    pairs_.add(flight.index, flight.candidates, flight.ray.reach);
    if (depart(flight)) waiting_[node].push(flight);
  }

  /// W rays more: what is in no tree is met at once, by all of them together.
  BOULE_NOINLINE bool prepare() {
    first_ += ready_;
    departed_ = ready_ = 0;
    if (first_ >= end_) return false;
    ready_ = stream_.live(first_);
    const PacketPlace place = stream_.packet(first_);
    prefetch_packet(stream_.rays(), first_ + prefetch_distance);
    RayLanes rays;
    load_packet(*place.rays, place.first, rays);
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
    flight.pending.clear();
    flight.next = geometry_.bvh.nodes;
    return true;
  }
  /// A ray that floats cannot judge, or that looks behind its origin.
  BOULE_NOINLINE void go_alone(std::size_t index) {
    RayLanes ray;
    load_single(stream_.rays(), index, ray);
    if constexpr (seeks_any) {
      AnyHit<true> best(ray);
      steps_ += search<Solver::robust, OnePerLane>(ray, geometry_, best);
      answers_[index] = best.hit != 0 ? 1 : 0;
    } else {
      ClosestHit best(ray);
      steps_ += search<Solver::robust, OnePerLane>(ray, geometry_, best);
      store_single(best, answers_, index);
    }
  }

  /// Spheres of leaves, W a part.
  static constexpr std::size_t parts = bvh_leaf_size / lanes;

  /// Steps: the spheres of leaves that may be hit become candidates. Few parts have any: which,
  /// cannot be foretold, and all are looked at before the first branch.
  BOULE_INLINE void visit_leaves(Flight* const* together, std::size_t count) {
    constexpr std::size_t at_once = 64 / parts;  // bits; all of them, but of scalar lanes
    for (std::size_t first = 0; first < count; first += at_once)
      visit_leaves_at_once(together + first, count - first < at_once ? count - first : at_once);
  }
  BOULE_INLINE void visit_leaves_at_once(Flight* const* together, std::size_t count) {
    Approach approaches[most_together * parts];
    std::uint64_t met = 0;
    for (std::size_t k = 0; k < count; ++k)
      met |= std::uint64_t{approach_leaf(*together[k], approaches + k * parts)} << k * parts;
    for (; met != 0; met &= met - 1) {
      const auto part = static_cast<std::size_t>(std::countr_zero(met));
      meet_leaf(*together[part / parts], part % parts * lanes, approaches[part]);
    }
  }
  /// Returns the parts of its leaf in which a flight may hit something, bit by bit.
  BOULE_INLINE unsigned approach_leaf(Flight& flight, Approach* approaches) {
    const auto& block = *static_cast<const SphereBlock*>(flight.next);
    const std::uint32_t slot = slot_of(block);
    const FilterRays rays = flight.ray.filter();
    const Real reach(flight.ray.reach);
    unsigned met = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t at = part * lanes;
      const Vec3<Real> center{load(block.center_x + at), load(block.center_y + at),
                              load(block.center_z + at)};
      const Real radius = load(block.radius + at);
      approaches[part] = find_approach(rays, center, radius);
      const RealMask may = may_meet(approaches[part], radius, reach);
      const RealMask own = source_in(flight, slot + static_cast<std::uint32_t>(at));
      met |= static_cast<unsigned>(any(may & ~own)) << part;
    }
    return met;
  }
  /// W spheres of its leaf, from `first` on.
  BOULE_INLINE void meet_leaf(Flight& flight, std::size_t first, const Approach& approach) {
    const std::uint32_t slot =
        slot_of(*static_cast<const SphereBlock*>(flight.next)) + static_cast<std::uint32_t>(first);
    const FilterRays rays = flight.ray.filter();
    const RealMask own = equal(geometry_.spheres.id + slot, flight.source);
    const NextRoots roots(approach, rays, Real(flight.ray.reach), own);
    flight.candidates.add(roots.low, count_from(slot), bits(roots.in));
    if constexpr (seeks_any) {
      if (any(roots.sure & (roots.high <= rays.live_to))) {
        answers_[flight.index] = 1;
        flight.pending.clear();
        flight.candidates.size = 0;
      }
    } else {
      const Real none(static_cast<float>(no_hit));
      flight.ray.reach =
          least_lane(lesser_or(select(roots.sure, roots.high, none), Real(flight.ray.reach)));
    }
    if (flight.candidates.size > FlightCandidates::most) make_room(flight);
  }
  /// A leaf's first sphere.
  [[nodiscard]] BOULE_INLINE std::uint32_t slot_of(const SphereBlock& block) const {
    return static_cast<std::uint32_t>(&block - geometry_.spheres.blocks) *
           static_cast<std::uint32_t>(bvh_leaf_size);
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
    RayLanes ray;
    load_single(stream_.rays(), flight.index, ray);
    for (unsigned first = 0; first < candidates.size; first += lanes) {
      for (unsigned k = candidates.size; k < first + lanes; ++k)
        candidates.slot[k] = candidates.slot[first];
      const SphereLanes spheres = gather_spheres(geometry_.spheres, load(candidates.slot + first));
      take(flight, ray, solve_robust(ray.exact, spheres), spheres.id);
    }
    steps_ += candidates.size / 2;
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
  std::size_t steps_ = 0;

  Flight flights_[most_flights];
  Waiting waiting_[kinds];
};

}  // namespace boule::BOULE_KERNEL_ISA
