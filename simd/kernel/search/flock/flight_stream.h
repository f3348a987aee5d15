#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/flock/departures.h"
#include "simd/kernel/search/flock/flight.h"
#include "simd/kernel/search/flock/pair_queue.h"
#include "simd/kernel/search/packet/tree_blocks.h"
#include "simd/kernel/tuning.h"

/// Nearest hits of streams of incoherent rays, many of them in flight at a time. Chosen in scenes
/// with a tree if Form says flight, and if a trial finds flights faster than packets and sets
/// (scattered_stream.h). In every round, up to twelve flights take a step of the same kind and
/// prefetch the memory of their next one. A ray that is done makes room for the next ray of the
/// stream. The hits are exact: floats only reject spheres or shorten a ray, and the remaining
/// spheres are solved in double. The order of the steps affects only the time.
namespace boule::BOULE_KERNEL_ISA {

/// Many rays in flight at a time.
class Flights {
 public:
  Flights(const GeometryView& geometry, const PaddedStream& stream, const HitStream& hits)
      : geometry_(geometry),
        stream_(stream),
        hits_(hits),
        blocks_(geometry),
        pairs_(stream.rays(), geometry.spheres, hits),
        departures_(geometry, stream, hits) {}

  /// Traces rays begin .. end - 1 of the stream, `begin` a multiple of W.
  void run(std::size_t begin, std::size_t end) {
    first_ = begin;
    departed_ = ready_ = 0;
    end_ = end;
    const std::size_t flights = blocks_.is_far() ? most_flights : tuning::flights_nearby;
    for (std::size_t k = 0; k < flights && depart(flights_[k]); ++k)
      waiting_[node].push(flights_[k]);
    while (round()) {
    }
    pairs_.finish();
  }

 private:
  static constexpr std::size_t most_flights = tuning::most_flights;
  static constexpr std::size_t most_together = tuning::steps_together;

  /// The step that a flight waits for: to visit a node, to visit a leaf, or to end.
  enum Kind : std::size_t { node, leaf, departure, kinds };

  /// The flights that wait for one kind of step, first in, first out. The wait gives the prefetched
  /// data time to arrive.
  class Waiting {
   public:
    [[nodiscard]] BOULE_INLINE std::size_t size() const { return end_ - begin_; }
    /// `count` is 1, or 0 if the flight waits elsewhere. The push has no branch, because the kind
    /// of the next step is unpredictable.
    BOULE_INLINE void push(Flight& flight, std::size_t count = 1) {
      flights_[end_ % room] = &flight;
      end_ += count;
    }
    BOULE_INLINE Flight& pop() { return *flights_[begin_++ % room]; }

   private:
    static constexpr std::size_t room = 2 * most_flights;
    static_assert(std::has_single_bit(room));
    Flight* flights_[room];
    std::size_t begin_ = 0, end_ = 0;
  };

  /// Takes steps of the kind that most flights wait for. Returns false if none waits.
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
    // This loop comes last: go_on() loads at once what the steps have just stored in pieces, and a
    // CPU must wait for such stores.
    for (std::size_t k = 0; k < count; ++k) go_on(*together[k]);
  }

  /// Finds the next kind of step of a flight, without a branch, because it is unpredictable.
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
  /// Ends a flight and gives its place to the next ray, if there is one.
  BOULE_INLINE void arrive(Flight& flight) {
    pairs_.add(flight.index, flight.candidates, flight.ray.reach);
    if (depart(flight)) waiting_[node].push(flight);
  }

  /// Starts the next ray that needs the tree. Returns false if there is none.
  BOULE_INLINE bool depart(Flight& flight) {
    do {
      if (departed_ == ready_ && !make_more_ready()) return false;
    } while (!departures_.depart(departed_++, flight));
    flight.candidates.size = 0;
    flight.pending.clear();
    flight.next = geometry_.bvh.nodes;
    return true;
  }
  /// Prepares W more rays. Returns false if there are none.
  BOULE_INLINE bool make_more_ready() {
    first_ += ready_;
    departed_ = ready_ = 0;
    if (first_ >= end_) return false;
    ready_ = departures_.make_ready(first_);
    return true;
  }

  /// Parts of a leaf, of W spheres each.
  static constexpr std::size_t parts = bvh_leaf_size / width;

  /// Visits leaves: their spheres that may be hit become candidates. Few parts have any, and which
  /// ones is unpredictable, so all parts are compared before the first branch.
  BOULE_INLINE void visit_leaves(Flight* const* together, std::size_t count) {
    constexpr std::size_t at_once = 64 / parts;  // leaves whose parts have a bit each in 64 bits
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
      meet_leaf(*together[part / parts], part % parts * width, approaches[part]);
    }
  }
  /// Returns the parts of its leaf in which a flight may have a hit, as bits.
  BOULE_INLINE unsigned approach_leaf(Flight& flight, Approach* approaches) {
    const auto& block = *static_cast<const SphereBlock*>(flight.next);
    const std::uint32_t slot = slot_of(geometry_.spheres, block);
    const FilterRays rays = flight.ray.filter();
    const Real reach(flight.ray.reach);
    unsigned met = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t at = part * width;
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
  /// Makes W spheres of the flight's leaf, from `first` on, candidates.
  BOULE_INLINE void meet_leaf(Flight& flight, std::size_t first, const Approach& approach) {
    const std::uint32_t slot =
        slot_of(geometry_.spheres, *static_cast<const SphereBlock*>(flight.next)) +
        static_cast<std::uint32_t>(first);
    const FilterRays rays = flight.ray.filter();
    const RealMask own = load_integers(geometry_.spheres.id + slot) == Bits(flight.source);
    const NextRoots roots(approach, rays, Real(flight.ray.reach), own);
    flight.candidates.add(roots.low, count_from(slot), bits(roots.in));
    const Real none(static_cast<float>(no_hit));
    flight.ray.reach =
        least_lane(lesser_or(select(roots.sure, roots.high, none), Real(flight.ray.reach)));
    if (flight.candidates.size > FlightCandidates::most) make_room(flight);
  }
  /// The lane of the sphere that the ray leaves, if it is among W, from `slot` on. The ray hits
  /// that sphere again only if it leaves it on its inside. It is then a candidate, because only
  /// double can find the hit.
  BOULE_INLINE RealMask source_in(Flight& flight, std::uint32_t slot) {
    const RealMask source = load_integers(geometry_.spheres.id + slot) == Bits(flight.source);
    if (flight.inside && any(source)) {
      flight.candidates.add(Real(-static_cast<float>(no_hit)), count_from(slot), bits(source));
    }
    return source;
  }

  /// Solves the candidates of a flight before its end. Where float bounds are too loose, as very
  /// far from a sphere, only solved hits shorten the `reach`.
  BOULE_NOINLINE void make_room(Flight& flight) {
    FlightCandidates& candidates = flight.candidates;
    candidates.drop_beyond(flight.ray.reach);
    if (candidates.size <= FlightCandidates::most) return;
    RayLanes ray;
    load_single(stream_.rays(), flight.index, ray);
    for (unsigned first = 0; first < candidates.size; first += width) {
      for (unsigned k = candidates.size; k < first + width; ++k)
        candidates.slot[k] = candidates.slot[first];
      const std::uint32_t* const slots = candidates.slot + first;
      const SphereLanes spheres = gather_spheres(geometry_.spheres, load_integers(slots));
      take(flight, ray, solve_robust(ray.exact, spheres), spheres.id, slots);
    }
    candidates.size = 0;
  }
  /// Takes solved hits of one ray and ends its reach at the nearest one.
  BOULE_INLINE void take(Flight& flight, const RayLanes& ray, const Roots& roots, const Bits& ids,
                         const std::uint32_t* slots) {
    alignas(64) double t[width];
    alignas(64) std::int32_t id[width];
    alignas(64) float reach[width];
    store(t, roots.t);
    store(id, ids);
    store(reach, ClosestHit::distance(roots.t, ray));
    for (unsigned hit = bits(roots.hit); hit != 0; hit &= hit - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(hit));
      answer(hits_, flight.index, {t[k], id[k], slots[k]});
      if (reach[k] < flight.ray.reach) flight.ray.reach = reach[k];
    }
  }

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const HitStream hits_;
  TreeBlocks blocks_;
  PairQueue<HitStream> pairs_;

  /// Rays first_ + departed_ .. first_ + ready_ - 1 are ready to start.
  Departures<HitStream> departures_;
  std::size_t first_ = 0, departed_ = 0, ready_ = 0, end_ = 0;

  Flight flights_[most_flights];
  Waiting waiting_[kinds];
};

}  // namespace boule::BOULE_KERNEL_ISA
