#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "simd/kernel/search/flock/departures.h"
#include "simd/kernel/search/flock/flight.h"
#include "simd/kernel/search/flock/pair_queue.h"
#include "simd/kernel/search/flock/set_candidates.h"
#include "simd/kernel/search/packet/ray_by_ray.h"
#include "simd/kernel/search/packet/tree_blocks.h"
#include "simd/kernel/tuning.h"

/// Streams of rays whose neighbours visit much the same nodes in any directions, a set of some
/// hundreds at a time. A set goes down the tree together: it visits a node once, with a list of the
/// rays that enter it, and each of them is tested against the node's sixteen boxes. The rays share
/// the cost of a visit and the wait for its memory. Chosen in scenes with a tree if Form says set,
/// if a trial finds sets faster (scattered_stream.h), and for the rays of sparse bundles. (Tsakok
/// 2009, "Faster Incoherent Rays: Multi-BVH Ray Stream Tracing".) The order of the visits affects
/// only the time.
namespace boule::BOULE_KERNEL_ISA {

/// The work of sets: how often a ray was tested against a node or a leaf, and how often a node or a
/// leaf was visited.
struct SetEffort {
  std::size_t steps = 0, visits = 0;
};

/// Sets of rays, one after the other. Answers: HitStream for nearest hits, std::uint8_t* for any.
template <class Answers>
class RaySets {
 public:
  static constexpr bool any_hit = Departures<Answers>::any_hit;

  RaySets(const GeometryView& geometry, const PaddedStream& stream, const Answers& answers)
      : geometry_(geometry),
        stream_(stream),
        answers_(answers),
        blocks_(geometry),
        departures_(geometry, stream, answers),
        pairs_(stream.rays(), geometry.spheres, answers) {}

  /// Traces rays begin .. end - 1 of the stream, `begin` a multiple of W.
  SetEffort run(std::size_t begin, std::size_t end) {
    effort_ = {};
    for (; begin < end; begin += tuning::set_size) {
      gather(begin, end - begin < tuning::set_size ? end : begin + tuning::set_size);
      if (size_ != 0) search();
    }
    pairs_.finish();
    const std::size_t alone = departures_.take_visits();
    return {effort_.steps + alone, effort_.visits + alone};
  }

 private:
  static constexpr std::size_t parts = bvh_width / width;
  static_assert(bvh_width == bvh_leaf_size);

  /// `ray.reach` is below everything once any hit is found.
  struct alignas(64) SetRay : TreeRay {};
  static_assert(sizeof(SetRay) == 128);

  /// A node or a leaf to visit, and the rays that visit it: `count` numbers of lists_, from `begin`
  /// on.
  struct alignas(32) Waiting {
    float near;  ///< for nearest hits: lower bound of the distance at which the first ray enters
    std::uint32_t child;
    std::uint32_t begin, count;
    std::uint32_t top;  ///< beyond it, lists_ holds only lists that are done
  };

  /// Makes a set of the rays among begin .. end - 1 that need the tree.
  BOULE_NOINLINE void gather(std::size_t begin, std::size_t end) {
    size_ = 0;
    for (std::size_t first = begin; first < end; first += width) {
      const std::size_t count = departures_.make_ready(first);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if (!departures_.depart(lane, rays_[size_])) continue;
        lists_[size_] = static_cast<std::uint32_t>(size_);
        ++size_;
      }
    }
  }

  /// Searches the tree for all rays of the set.
  BOULE_NOINLINE void search() {
    const auto all = static_cast<std::uint32_t>(size_);
    waiting_[0] = {0, 0, 0, all, all};
    waiting_count_ = 1;
    while (waiting_count_ != 0) {
      const Waiting now = waiting_[--waiting_count_];
      effort_.steps += now.count;
      ++effort_.visits;
      const void* const block = blocks_.at(now.child);
      if ((now.child & leaf_bit) == 0) {
        visit_node(*static_cast<const BvhNode*>(block), now);
      } else {
        visit_leaf(*static_cast<const SphereBlock*>(block), now);
      }
    }
    if constexpr (!any_hit) solve_candidates();
  }

  /// Tests the rays of a list against the boxes of a node, and adds a list for each child that some
  /// of them enter.
  BOULE_INLINE void visit_node(const BvhNode& node, const Waiting& now) {
    const std::uint32_t* const list = lists_ + now.begin;
    Real least[parts];
    for (Real& near : least) near = Real(static_cast<float>(no_hit));
    unsigned entered = 0;
    for (std::uint32_t k = 0; k < now.count; ++k) {
      entered_[k] = enter(rays_[list[k]], node, least);
      entered |= entered_[k];
    }
    alignas(64) float near[bvh_width];
    for (std::size_t part = 0; part < parts; ++part) store(near + part * width, least[part]);
    const std::size_t base = waiting_count_;
    std::uint32_t top = now.top;
    for (; entered != 0; entered &= entered - 1) {
      const auto k = static_cast<unsigned>(std::countr_zero(entered));
      const std::uint32_t count = list_rays(k, list, now.count, lists_ + top);
      wait({near[k], node.child[k], top, count, 0}, base);
      top += count;
      blocks_.fetch(node.child[k]);
    }
    for (std::size_t at = base; at < waiting_count_; ++at) waiting_[at].top = top;
  }
  /// The children of a node that a ray enters, as bits. Lowers `least` to the entry distances.
  BOULE_INLINE static unsigned enter(const SetRay& ray, const BvhNode& node, Real* least) {
    unsigned in = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const Passage passage = enter_children(ray.ray, ray.rows, node, part * width);
      in |= bits(passage.in) << part * width;
      if constexpr (!any_hit) {
        const RealMask nearer = passage.in & (passage.near < least[part]);
        least[part] = select(nearer, passage.near, least[part]);
      }
    }
    return in;
  }
  /// Lists the rays of a list that enter the k-th child. Returns their number.
  BOULE_INLINE std::uint32_t list_rays(unsigned k, const std::uint32_t* from, std::uint32_t count,
                                       std::uint32_t* to) const {
    const Bits child(1U << k), none(0U);
    std::uint32_t added = 0;
    for (std::uint32_t first = 0; first < count; first += width) {
      const std::uint32_t left = count - first;
      const unsigned there = left < width ? (1U << left) - 1 : all_lanes;
      const unsigned in = there & ~bits((load_integers(entered_ + first) & child) == none);
      store_chosen(to + added, load_anywhere(from + first), in);
      added += static_cast<std::uint32_t>(std::popcount(in));
    }
    return added;
  }
  /// Adds a child of the node whose first child was added at `base`. For nearest hits, the nearest
  /// child is visited first.
  BOULE_INLINE void wait(const Waiting& child, std::size_t base) {
    std::size_t at = waiting_count_++;
    if constexpr (!any_hit) {
      for (; at > base && waiting_[at - 1].near < child.near; --at) waiting_[at] = waiting_[at - 1];
    }
    waiting_[at] = child;
  }

  /// Tests the rays of a list against the spheres of a leaf: first all by the reject, because few
  /// hit any and which ones is unpredictable, then those that pass it.
  BOULE_INLINE void visit_leaf(const SphereBlock& leaf, const Waiting& now) {
    const std::uint32_t slot = slot_of(geometry_.spheres, leaf);
    const std::uint32_t* const list = lists_ + now.begin;
    std::size_t met = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t at = part * width;
      const RejectSpheres spheres(
          {load(leaf.center_x + at), load(leaf.center_y + at), load(leaf.center_z + at)},
          load(leaf.radius + at));
      const Bits ids = load_integers(geometry_.spheres.id + slot + at);
      for (std::uint32_t k = 0; k < now.count; ++k) {
        const SetRay& ray = rays_[list[k]];
        const RealMask own = ids == Bits(ray.source);
        const RealMask may =
            spheres.may_meet(FlightRay::all(ray.ray.org), FlightRay::all(ray.ray.h),
                             ray.ray.origin_error, ray.ray.reach);
        met_[met] = {list[k], static_cast<std::uint32_t>(at)};
        met += any(may & ~own) || (ray.inside && any(own)) ? 1 : 0;
      }
    }
    for (std::size_t k = 0; k < met; ++k) meet(rays_[met_[k].ray], leaf, slot, met_[k].at);
    if constexpr (!any_hit) {
      if (candidates_.is_full()) make_room();
    }
  }
  /// Decides about a ray and W spheres of a leaf, from `at` on, as far as float can.
  BOULE_INLINE void meet(SetRay& ray, const SphereBlock& leaf, std::uint32_t slot,
                         std::uint32_t at) {
    const FilterRays rays = ray.ray.filter();
    const Vec3<Real> center{load(leaf.center_x + at), load(leaf.center_y + at),
                            load(leaf.center_z + at)};
    const Approach approach = find_approach(rays, center, load(leaf.radius + at));
    const std::uint32_t first = slot + at;
    // The ray hits its own sphere again only if it leaves it on its inside; only double can find
    // the hit.
    const RealMask own = load_integers(geometry_.spheres.id + first) == Bits(ray.source);
    const NextRoots roots(approach, rays, Real(ray.ray.reach), own);
    const RealMask again = own & uniform(ray.inside);
    if constexpr (any_hit) {
      const bool sure = any(roots.sure & (roots.high <= rays.live_to));
      if (sure) answers_[ray.index] = 1;
      if (answers_[ray.index] != 0) {
        ray.ray.reach = -std::numeric_limits<float>::max();
      } else {
        pairs_.add(ray.index, first, bits(roots.in | again));
      }
    } else {
      const Real none(static_cast<float>(no_hit));
      const Real high = select(roots.sure, roots.high, none);
      ray.ray.reach = least_lane(lesser_or(high, Real(ray.ray.reach)));
      candidates_.add(static_cast<std::uint32_t>(&ray - rays_), first,
                      select(again, Real(0.0F) - none, roots.low), bits(roots.in | again));
    }
  }

  /// Passes the candidates that may be nearest to the double solver.
  BOULE_INLINE void solve_candidates() {
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const SetRay& ray = rays_[candidates_.ray(k)];
      pairs_.add_if(candidates_.low(k) <= ray.ray.reach, ray.index, candidates_.slot(k));
    }
    candidates_.clear();
  }
  /// Solves the candidates before the search ends. Where float bounds are too loose, as very far
  /// from a sphere, only solved hits shorten the reach of a ray.
  BOULE_NOINLINE void make_room() {
    solve_candidates();
    pairs_.finish();
    for (std::size_t k = 0; k < size_; ++k) {
      RayLanes ray;
      load_single(stream_.rays(), rays_[k].index, ray);
      const float solved = get_lane(ClosestHit::distance(Wide(answers_.t[rays_[k].index]), ray), 0);
      if (solved < rays_[k].ray.reach) rays_[k].ray.reach = solved;
    }
  }

  struct Met {
    std::uint32_t ray, at;
  };
  /// The root, and up to fifteen siblings of each node on the path to a leaf.
  static constexpr std::size_t most_waiting = bvh_max_depth * (bvh_width - 1) + 1;

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const Answers answers_;
  TreeBlocks blocks_;
  Departures<Answers> departures_;
  PairQueue<Answers> pairs_;
  SetEffort effort_;
  std::size_t size_ = 0, waiting_count_ = 0;
  SetRay rays_[tuning::set_size];
  Met met_[tuning::set_size * parts + 1];  ///< one more is written than is kept
  alignas(
      64) std::uint32_t entered_[tuning::set_size];  ///< by the rays of a list: children, as bits
  Waiting waiting_[most_waiting];
  /// The lists of sixteen children for each node on a path, and W that are written beyond the last.
  std::uint32_t lists_[(bvh_max_depth * bvh_width + 1) * tuning::set_size + width];
  std::conditional_t<any_hit, NoCandidates, SetCandidates> candidates_;
};

}  // namespace boule::BOULE_KERNEL_ISA
