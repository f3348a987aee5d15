#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/kernel/search/bundle/bundle_lines.h"

/// The nearest hits of a bundle's rays. As long as float is certain which sphere is the nearest,
/// only its slot is kept, with bounds of its v: most rays then need one double solve, at the end.
/// Where float cannot order two spheres, double decides at once; the smaller (t, id) wins, as
/// everywhere.
namespace boule::BOULE_KERNEL_ISA {

/// The nearest hits of a bundle. Spheres: SphereView, or PartSpheres (parts.h).
template <Common common, class Spheres>
class BundleClosest {
 public:
  static constexpr Sought sought = Sought::nearest;

  BundleClosest(const RaysInOrder<common>& source, const Spheres& spheres, const BundleRays& rays)
      : source_(source), spheres_(spheres), rays_(rays) {
    for (int p = 0; p < rays.packets; ++p) start(p * width);
    for (int group = 0; group < bundle_groups; ++group) update(group);
    update();
  }

  /// For each group the largest v at which a hit still counts.
  [[nodiscard]] const float* limits() const { return limits_; }
  /// The largest of limits(), as of the last update().
  [[nodiscard]] float limit() const { return limit_; }
  /// The smallest of limits().
  [[nodiscard]] BOULE_INLINE float least_limit() const {
    Real least = load(limits_);
    for (int at = width; at < bundle_groups; at += width)
      least = filter_min(least, load(limits_ + at));
    return least_lane(least);
  }
  [[nodiscard]] bool done() const { return false; }
  [[nodiscard]] bool too_close() const { return false; }

  /// Tests a simple sphere against the rays of a group. Returns whether their hits may have
  /// changed; if so, call update() before limit().
  BOULE_INLINE bool meet(int group, const DiscLanes& disc, std::uint32_t slot) {
    const PacketRange packets = packets_of(rays_, group);
    bool changed = false;
    int p = packets.begin;
    for (; p + 2 <= packets.end; p += 2) {
      const int ray = p * width;
      const Real q0 = disc_square<common>(rays_, ray, disc);
      const Real q1 = disc_square<common>(rays_, ray + width, disc);
      // A branch for each of them costs more than it saves.
      if (!any((Real(0.0F) <= q0) | (Real(0.0F) <= q1))) continue;
      changed |= consider(ray, disc, q0, slot);
      changed |= consider(ray + width, disc, q1, slot);
    }
    if (p < packets.end) {
      const Real q = disc_square<common>(rays_, p * width, disc);
      changed |= consider(p * width, disc, q, slot);
    }
    if (changed) update(group);
    return changed;
  }

  /// Recomputes limit().
  BOULE_INLINE void update() { limit_ = greatest_of_groups(limits_); }

  /// Tests a sphere that is not simple against all rays.
  BOULE_NOINLINE void meet_awkward(std::uint32_t slot) {
    for (int p = 0; p < rays_.packets; ++p) resolve(p * width, slot, all_lanes);
    for (int group = 0; group < bundle_groups; ++group) update(group);
    update();
  }

  /// Solves the pending hits, adds the planes and writes the hits.
  BOULE_INLINE void finish(const PlaneView& planes, const HitStream& hits) {
    for (int p = 0; p < rays_.packets; ++p) finish(p * width, planes, hits);
  }

 private:
  BOULE_INLINE void update(int group) {
    const PacketRange packets = packets_of(rays_, group);
    Real most(-static_cast<float>(no_hit));
    for (int p = packets.begin; p < packets.end; ++p) {
      const Real high = load(high_ + p * width);
      most = select(most < high, high, most);  // skips NaN
    }
    limits_[group] = greatest_lane(most);
  }

  BOULE_INLINE void start(int ray) {
    const Real largest(std::numeric_limits<float>::max()), tmax = load(source_.start(ray).tmax);
    // NaN stays, and no hit is nearer than NaN. Infinity stays, and every float is nearer.
    const Real end = select(largest < tmax, largest, tmax) * load(rays_.scale + ray);
    store(low_ + ray, end);
    store(high_ + ray, end);
    store(slot_ + ray, Bits(no_slot));
    store(solved_ + ray, Bits(no_slot));
    solved_any_[ray / width] = uniform_[ray / width] = false;
  }

  /// Lets float decide about a sphere and W rays, and double where float is undecided. Returns
  /// whether anything may have changed.
  BOULE_INLINE bool consider(int ray, const DiscLanes& disc, const Real& q, std::uint32_t slot) {
    const Real low = load(low_ + ray), high = load(high_ + ray);
    const Real from = first_root<common>(LineLanes::each<common>(rays_, ray), disc, q),
               to = from + disc.spread;
    const RealMask candidate = from <= high;  // false for Q < 0
    if (!any(candidate)) return false;
    const RealMask nearer = candidate & (disc.sure <= q) & (to < low);
    store(low_ + ray, select(nearer, from, low));
    store(high_ + ray, select(nearer, to, high));
    store(slot_ + ray, select(nearer, Bits(slot), load_integers(slot_ + ray)));
    const unsigned unclear = bits(candidate & ~nearer);
    const bool changed = any(nearer);
    uniform_[ray / width] = changed ? all(nearer) : uniform_[ray / width];
    if (unclear != 0) resolve(ray, slot, unclear);
    return true;
  }

  /// Solves a sphere for W rays; rays whose bits are set in `lanes` take it if it is the nearest.
  BOULE_NOINLINE void resolve(int ray, std::uint32_t slot, unsigned lanes) {
    ExactRays rays;
    load_exact<common>(source_.packet(ray), rays_, rays);
    const Roots roots = solve_robust(rays, broadcast_slot(spheres_, slot));
    alignas(64) double t[width];
    store(t, roots.t);
    lanes &= bits(roots.hit);
    bool settled = false;
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes), i = ray + lane;
      const float v = static_cast<float>(t[lane]) * rays_.scale[i];
      if (high_[i] < v) continue;
      if (!(v < low_[i]) && slot_[i] != no_slot) {
        if (!settled) settle(ray, rays);
        settled = true;
        const bool tie =
            t[lane] == t_[i] && is_lower(id_of(spheres_, slot), id_of(spheres_, slot_[i]));
        if (!(t[lane] < t_[i] || tie)) continue;
      }
      t_[i] = t[lane];
      slot_[i] = solved_[i] = slot;
      solved_any_[ray / width] = true;
      uniform_[ray / width] = false;
      low_[i] = high_[i] = v;
    }
  }

  /// Solves the hits of W rays that are known only by their float bounds.
  void settle(int ray, const ExactRays& rays) {
    bool pending = false;
    for (int i = ray; i < ray + width; ++i) pending |= slot_[i] != solved_[i];
    if (!pending) return;
    alignas(64) double t[width];
    store(t, solve_first(rays, gather_slots(spheres_, slot_ + ray)));
    for (int lane = 0; lane < width; ++lane) {
      const int i = ray + lane;
      if (slot_[i] == solved_[i]) continue;
      t_[i] = t[lane];
      solved_[i] = slot_[i];
    }
    solved_any_[ray / width] = true;
  }

  BOULE_INLINE void finish(int ray, const PlaneView& planes, const HitStream& hits) {
    const std::size_t first = source_.first() + static_cast<std::size_t>(ray);
    if (solved_any_[ray / width] || planes.size != 0 || source_.live(ray) != width) {
      finish_any(ray, planes, hits);
      return;
    }
    const WideMask hit = has_hit(ray);
    if (!any(hit)) {
      store(hits.t + first, Wide(no_hit));
      store(hits.id + first, Bits(no_primitive));
      return;
    }
    ExactRays rays;
    load_exact<common, Origins::bundle>(source_.packet(ray), rays_, rays);
    const Wide t = solve_first(rays, uniform_[ray / width] ? broadcast_slot(spheres_, slot_[ray])
                                                           : gather_slots(spheres_, slot_ + ray));
    store(hits.t + first, select(hit, t, Wide(no_hit)));
    store(hits.slot + first, load_integers(slot_ + ray));
    find_ids(ray, hits.id + first);
  }

  /// The same with planes, hits that were solved before, and copies of the stream's last ray.
  BOULE_NOINLINE void finish_any(int ray, const PlaneView& planes, const HitStream& hits) {
    ExactRays rays;
    load_exact<common>(source_.packet(ray), rays_, rays);
    settle(ray, rays);
    alignas(64) double t[width];
    alignas(64) std::int32_t id[width];
    store(t, select(has_hit(ray), load(t_ + ray), Wide(no_hit)));
    find_ids(ray, id);
    meet_planes(rays, planes, t, id);
    const std::size_t first = source_.first() + static_cast<std::size_t>(ray);
    const auto live = static_cast<std::size_t>(source_.live(ray));
    for (std::size_t lane = 0; lane < live; ++lane) {
      hits.t[first + lane] = t[lane];
      hits.id[first + lane] = id[lane];
      hits.slot[first + lane] = slot_[static_cast<std::size_t>(ray) + lane];
    }
  }

  /// The lanes, of W rays, that hit a sphere.
  BOULE_INLINE WideMask has_hit(int ray) const {
    return widen(~(load_integers(slot_ + ray) == Bits(no_slot)));
  }
  BOULE_INLINE void find_ids(int ray, std::int32_t* id) const {
    if (uniform_[ray / width]) {
      store(id, Bits(id_of(spheres_, slot_[ray])));
      return;
    }
    for (int lane = 0; lane < width; ++lane) {
      const std::uint32_t slot = slot_[ray + lane];
      id[lane] = slot == no_slot ? no_primitive : id_of(spheres_, slot);
    }
  }

  /// Adds the planes to W nearest hits.
  static void meet_planes(const ExactRays& rays, const PlaneView& planes, double* t,
                          std::int32_t* id) {
    Wide nearest = load(t);
    Bits primitive = load_integers(id);
    for (std::size_t k = 0; k < planes.size; ++k) {
      const PlaneLanes plane = get_plane<OneForAll>(planes, k);
      const Roots roots = solve_robust(rays, plane);
      const WideMask better = roots.hit & (roots.t < nearest);  // spheres have the lower ids
      nearest = select(better, roots.t, nearest);
      primitive = select(narrow(better), plane.id, primitive);
    }
    store(t, nearest);
    store(id, primitive);
  }

  const RaysInOrder<common>& source_;
  const Spheres& spheres_;
  const BundleRays& rays_;
  float limit_ = 0;
  alignas(64) float limits_[bundle_groups];
  alignas(64) float low_[bundle_size];   ///< lower bound of v of the hit, or of the end of the ray
  alignas(64) float high_[bundle_size];  ///< upper bound of it
  alignas(64) std::uint32_t slot_[bundle_size];  ///< of the sphere that is hit, or no_slot
  alignas(64) double t_[bundle_size];            ///< of the hit, where solved_ equals slot_
  alignas(64) std::uint32_t solved_[bundle_size];
  bool solved_any_[bundle_packets];  ///< some lane's slot may be solved
  bool uniform_[bundle_packets];     ///< all lanes have the same slot
};

}  // namespace boule::BOULE_KERNEL_ISA
