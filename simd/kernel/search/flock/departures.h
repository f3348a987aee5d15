#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/kernel/search/flock/flight.h"
#include "simd/kernel/search/leaf/scan.h"
#include "simd/kernel/search/leaf/slabs.h"
#include "simd/kernel/search/packet/packet_hits.h"
#include "simd/kernel/search/packet/packet_stream.h"

/// The start of rays that traverse the tree one by one, as flights or sets. W rays at a time are
/// tested against the spheres outside the leaves, and W at a time get the data for their steps
/// through the tree, which are kept until the ray starts.
namespace boule::BOULE_KERNEL_ISA {

/// Answers: HitStream for nearest hits, std::uint8_t* for any.
template <class Answers>
class Departures {
 public:
  static constexpr bool any_hit = !std::is_same_v<Answers, HitStream>;

  Departures(const GeometryView& geometry, const PaddedStream& stream, const Answers& answers)
      : geometry_(geometry), stream_(stream), answers_(answers) {}

  /// Prepares the rays of the packet at `first`, a multiple of W, and answers for the spheres
  /// outside the leaves. Returns how many of the lanes are rays of the stream.
  BOULE_NOINLINE std::size_t make_ready(std::size_t first) {
    const std::size_t count = stream_.live(first);
    RayLanes rays;
    load_ahead(stream_, first, rays);
    first_ = first;
    if constexpr (any_hit) {
      AnyHit<false> best(rays);
      meet_scanned(rays, best);
      store_packet(best, answers_, first, count);
      set(rays, best.far);
      open_ &= ~best.hit;
    } else {
      ClosestHit best(rays);
      meet_scanned(rays, best);
      store_packet(best, answers_, first, count);
      set(rays, best.reach);
    }
    return count;
  }
  /// Prepares the ray of a lane. Returns false if the ray needs no traversal: its answer is known,
  /// or it is traced alone at once, because float cannot judge it or it has hits behind its origin.
  BOULE_INLINE bool depart(std::size_t lane, TreeRay& to) {
    if ((open_ >> lane & 1U) == 0) return false;
    if ((judged_ >> lane & 1U) == 0) {
      go_alone(first_ + lane);
      return false;
    }
    rows_.get(lane, to.ray);
    to.rows.choose(to.ray);
    to.index = static_cast<std::uint32_t>(first_ + lane);
    const RayStream& rays = stream_.rays();
    const std::size_t start = rays.places(to.index).start;
    to.source = rays.source[start];
    to.inside = rays.inside[start] != 0;
    return true;
  }
  /// The nodes and leaves visited by rays that were traced alone, since the last call.
  std::size_t take_visits() {
    const std::size_t visits = visits_;
    visits_ = 0;
    return visits;
  }

 private:
  template <class Best>
  BOULE_INLINE void meet_scanned(const RayLanes& rays, Best& best) {
    scan_spheres<OneForAll>(rays, Solver::robust, geometry_.spheres, best);
    best.settle(geometry_.spheres, rays);
    scan_planes<OneForAll>(rays, Solver::robust, geometry_.planes, best);
  }
  /// `reach`: the largest t |dir| at which a hit still counts.
  BOULE_INLINE void set(const RayLanes& packet, const Real& reach) {
    rows_.set(packet, geometry_.bvh.extent, reach);
    judged_ = bits(is_judged(packet.filter));
    open_ = bits(Real(0.0F) <= reach) | (all_lanes & ~judged_);
  }
  /// Traces a ray as a single ray.
  BOULE_NOINLINE void go_alone(std::size_t index) {
    visits_ +=
        trace_groups(geometry_, stream_, index, index + 1, Solver::robust, Form::single, answers_);
  }

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const Answers answers_;
  std::size_t first_ = 0, visits_ = 0;
  unsigned judged_ = 0;
  unsigned open_ = 0;  ///< lanes that may still find a hit in the tree
  FlightRows rows_;
};

}  // namespace boule::BOULE_KERNEL_ISA
