#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/kernel/search/bundle_discs.h"
#include "simd/kernel/search/bundle_rays.h"

/// What a bundle's rays have hit. Most rays need one double solve at all, in the end: while float
/// can tell which sphere is the nearest, only its slot is kept, with bounds of v (filter_bounds.h).
namespace boule::BOULE_KERNEL_ISA {

/// No sphere's slot.
inline constexpr std::uint32_t no_slot = 0xffffffffU;

/// Slots travel through lanes as floats that are never calculated with, but no_slot is told from
/// others by being NaN: the bits of slots below this are no NaN.
inline constexpr std::size_t most_bundle_slots = 0x7f800000U;
BOULE_INLINE float slot_bits(std::uint32_t slot) { return std::bit_cast<float>(slot); }
BOULE_INLINE std::uint32_t slot_of(float bits) { return std::bit_cast<std::uint32_t>(bits); }

/// One disc in every lane, or W of them.
struct DiscLanes {
  Real x, y, z, squared, sure, depth, spread;

  /// Disc k in every lane.
  BOULE_INLINE static DiscLanes same(const Discs& discs, int k) {
    return {discs.x[k],    discs.y[k],     discs.z[k],     discs.squared[k],
            discs.sure[k], discs.depth[k], discs.spread[k]};
  }
  /// Discs from `at` on, a disc a lane.
  BOULE_INLINE static DiscLanes each(const Discs& discs, int at) {
    return {load(discs.x + at),       load(discs.y + at),    load(discs.z + at),
            load(discs.squared + at), load(discs.sure + at), load(discs.depth + at),
            load(discs.spread + at)};
  }
};

/// W rays of a bundle, or one in every lane.
struct LineLanes {
  Real a, b, c;  ///< c with one direction only

  template <Common common>
  BOULE_INLINE static LineLanes each(const BundleRays& rays, int ray) {
    constexpr bool parallel = common == Common::direction;
    return {load(rays.a + ray), load(rays.b + ray), parallel ? load(rays.c + ray) : Real(0.0F)};
  }
  template <Common common>
  BOULE_INLINE static LineLanes same(const BundleRays& rays, int ray) {
    constexpr bool parallel = common == Common::direction;
    return {rays.a[ray], rays.b[ray], parallel ? rays.c[ray] : 0.0F};
  }
};

/// Q: negative where lines miss discs for certain.
template <Common common>
BOULE_INLINE Real disc_square(const LineLanes& line, const DiscLanes& disc) {
  Real e1, e2;
  if constexpr (common != Common::direction) {
    e1 = filter_fnma(line.a, disc.z, disc.x);
    e2 = filter_fnma(line.b, disc.z, disc.y);
  } else {
    e1 = disc.x - line.a;
    e2 = disc.y - line.b;
  }
  return filter_fnma(e2, e2, filter_fnma(e1, e1, disc.squared));
}
template <Common common>
BOULE_INLINE Real disc_square(const BundleRays& rays, int ray, const DiscLanes& disc) {
  return disc_square<common>(LineLanes::each<common>(rays, ray), disc);
}

/// Lower bound of the first root, in v; NaN for Q < 0.
template <Common common>
BOULE_INLINE Real first_root(const LineLanes& line, const DiscLanes& disc, const Real& q) {
  const Real root = sqrt(q);
  if constexpr (common != Common::direction) {
    return filter_fma(disc.x, line.a, filter_fma(disc.y, line.b, disc.depth)) - root;
  } else {
    return disc.depth - line.c - root;
  }
}

/// Whose origins the solver takes: the bundle's is in registers, and any ray's but for the sign of
/// a zero, which a sphere around it would show.
enum class Origins { bundle, own };

/// W rays of a bundle as the double solver sees them.
template <Common common, Origins origins = Origins::own>
BOULE_INLINE void load_exact(const PacketPlace& place, const BundleRays& bundle, ExactRays& out) {
  const RayStream& rays = *place.rays;
  const std::size_t first = place.first;
  out.org = common == Common::origin && origins == Origins::bundle
                ? wide_all(bundle.frame.org)
                : Vec3<Wide>{load(rays.org_x + first), load(rays.org_y + first),
                             load(rays.org_z + first)};
  out.dir = {widen(load(rays.dir_x + first)), widen(load(rays.dir_y + first)),
             widen(load(rays.dir_z + first))};
  out.a = dot(out.dir, out.dir);
  out.inverse_a = Wide(1.0) / out.a;
  const Wide largest(static_cast<double>(std::numeric_limits<float>::max()));
  const Wide tmax = widen(load(rays.tmax + first));
  out.tmin = Wide(0.0);
  out.tmax = select(largest < tmax, largest, tmax);
  out.source = Wide(-1.0);
  out.inside = Wide(0.0) < Wide(0.0);
  out.has_source = false;
}

/// The spheres in W slots; any sphere where there is none. (The CPU's own gather is slower.)
BOULE_INLINE SphereLanes gather_slots(const SphereView& s, const float* slots) {
  alignas(64) float x[width], y[width], z[width], r[width];
  for (int lane = 0; lane < width; ++lane) {
    const std::uint32_t slot = slot_of(slots[lane]);
    const SlotSphere sphere = get_slot(s, slot == no_slot ? 0 : slot);
    x[lane] = sphere.x;
    y[lane] = sphere.y;
    z[lane] = sphere.z;
    r[lane] = sphere.radius;
  }
  return {{load(x), load(y), load(z)}, load(r), Wide(-1.0)};
}

/// The sphere in one slot, for every lane.
BOULE_INLINE SphereLanes broadcast_slot(const SphereView& s, std::uint32_t slot) {
  const SlotSphere sphere = get_slot(s, slot);
  return {{sphere.x, sphere.y, sphere.z}, sphere.radius, static_cast<double>(s.id[slot])};
}

/// The first root of spheres that are simple and hit for certain: what solve_robust() gives, less
/// what it need not ask.
BOULE_INLINE Wide solve_first(const ExactRays& rays, const SphereLanes& sphere) {
  const Vec3<Wide> f = widen(sphere.center) - rays.org;
  const Wide r = widen(sphere.radius);
  const Wide b = dot(f, rays.dir);
  const Vec3<Wide> l = f - rays.dir * (b * rays.inverse_a);
  const Wide discriminant = r * r - dot(l, l);
  return (dot(f, f) - r * r) / (b + sqrt(rays.a * discriminant));
}

BOULE_INLINE float greatest_limit(const float* limits) {
  Real most = load(limits);
  for (int at = width; at < bundle_groups; at += width) most = filter_max(most, load(limits + at));
  return greatest_lane(most);
}

/// The nearest hits of a bundle.
template <Common common>
class BundleHits {
 public:
  static constexpr Seek seek = Seek::nearest;

  BundleHits(const RaysInPlace<common>& source, const SphereView& spheres, const BundleRays& rays)
      : source_(source), spheres_(spheres), rays_(rays) {
    for (int p = 0; p < rays.packets; ++p) start(p * width);
    for (int group = 0; group < bundle_groups; ++group) update(group);
    update();
  }

  /// By group: no hit beyond this v is of interest.
  [[nodiscard]] const float* limits() const { return limits_; }
  [[nodiscard]] float limit() const { return limit_; }
  [[nodiscard]] bool done() const { return false; }
  [[nodiscard]] bool too_close() const { return false; }

  /// A simple sphere against a group; true if that changes its hits: update() then.
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

  /// Finds limit() again.
  BOULE_INLINE void update() { limit_ = greatest_limit(limits_); }

  /// Any other sphere against all rays.
  BOULE_NOINLINE void meet_awkward(std::uint32_t slot) {
    for (int p = 0; p < rays_.packets; ++p) resolve(p * width, slot, all_lanes);
    for (int group = 0; group < bundle_groups; ++group) update(group);
    update();
  }

  /// Solves what is hit, adds the planes, writes it all.
  BOULE_INLINE void finish(const PlaneView& planes, const HitStream& hits) {
    for (int p = 0; p < rays_.packets; ++p) finish(p * width, planes, hits);
  }

 private:
  BOULE_INLINE void update(int group) {
    const PacketRange packets = packets_of(rays_, group);
    Real most(-static_cast<float>(no_hit));
    for (int p = packets.begin; p < packets.end; ++p) {
      const Real high = load(high_ + p * width);
      most = select(most < high, high, most);  // NaN is left out
    }
    limits_[group] = greatest_lane(most);
  }

  BOULE_INLINE void start(int ray) {
    const Real largest(std::numeric_limits<float>::max()), tmax = source_.tmax(ray);
    // NaN stays: nothing is nearer than that. Infinity stays as well: all floats are.
    const Real end = select(largest < tmax, largest, tmax) * load(rays_.scale + ray);
    store(low_ + ray, end);
    store(high_ + ray, end);
    store(slot_ + ray, Real(slot_bits(no_slot)));
    store(solved_ + ray, Real(slot_bits(no_slot)));
    solved_any_[ray / width] = uniform_[ray / width] = false;
  }

  /// What float knows of a sphere in W rays; true if that changes anything.
  BOULE_INLINE bool consider(int ray, const DiscLanes& disc, const Real& q, std::uint32_t slot) {
    const Real low = load(low_ + ray), high = load(high_ + ray);
    const Real from = first_root<common>(LineLanes::each<common>(rays_, ray), disc, q),
               to = from + disc.spread;
    const RealMask candidate = from <= high;  // false for Q < 0
    if (!any(candidate)) return false;
    const RealMask nearer = candidate & (disc.sure <= q) & (to < low);
    store(low_ + ray, select(nearer, from, low));
    store(high_ + ray, select(nearer, to, high));
    store(slot_ + ray, select(nearer, Real(slot_bits(slot)), load(slot_ + ray)));
    const unsigned unclear = bits(candidate & ~nearer);
    const bool changed = any(nearer);
    uniform_[ray / width] = changed ? all(nearer) : uniform_[ray / width];
    if (unclear != 0) resolve(ray, slot, unclear);
    return true;
  }

  /// Solves a sphere for W rays; those of `lanes` may take it.
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
      if (!(v < low_[i]) && slot_of(slot_[i]) != no_slot) {
        if (!settled) settle(ray, rays);
        settled = true;
        const bool tie = t[lane] == t_[i] && spheres_.id[slot] < spheres_.id[slot_of(slot_[i])];
        if (!(t[lane] < t_[i] || tie)) continue;
      }
      t_[i] = t[lane];
      slot_[i] = solved_[i] = slot_bits(slot);
      solved_any_[ray / width] = true;
      uniform_[ray / width] = false;
      low_[i] = high_[i] = v;
    }
  }

  /// Solves the hits of W rays that only float knows yet.
  void settle(int ray, const ExactRays& rays) {
    bool pending = false;
    for (int i = ray; i < ray + width; ++i) pending |= slot_of(slot_[i]) != slot_of(solved_[i]);
    if (!pending) return;
    alignas(64) double t[width];
    store(t, solve_first(rays, gather_slots(spheres_, slot_ + ray)));
    for (int lane = 0; lane < width; ++lane) {
      const int i = ray + lane;
      if (slot_of(slot_[i]) == slot_of(solved_[i])) continue;
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
    const Real slots = load(slot_ + ray);
    const WideMask hit = widen(slots <= slots);  // no_slot is NaN
    if (!any(hit)) {
      store(hits.t + first, Wide(no_hit));
      for (std::size_t lane = 0; lane < static_cast<std::size_t>(width); ++lane)
        hits.id[first + lane] = -1;
      return;
    }
    ExactRays rays;
    load_exact<common, Origins::bundle>(source_.packet(ray), rays_, rays);
    const Wide t =
        solve_first(rays, uniform_[ray / width] ? broadcast_slot(spheres_, slot_of(slot_[ray]))
                                                : gather_slots(spheres_, slot_ + ray));
    store(hits.t + first, select(hit, t, Wide(no_hit)));
    find_ids(ray, hits.id + first);
  }

  /// The same with whatever may come up.
  BOULE_NOINLINE void finish_any(int ray, const PlaneView& planes, const HitStream& hits) {
    ExactRays rays;
    load_exact<common>(source_.packet(ray), rays_, rays);
    settle(ray, rays);
    const Real slots = load(slot_ + ray);
    alignas(64) double t[width];
    alignas(64) std::int32_t id[width];
    store(t, select(widen(slots <= slots), load(t_ + ray), Wide(no_hit)));
    find_ids(ray, id);
    meet_planes(rays, planes, t, id);
    const std::size_t first = source_.first() + static_cast<std::size_t>(ray);
    const auto live = static_cast<std::size_t>(source_.live(ray));
    for (std::size_t lane = 0; lane < live; ++lane) {
      hits.t[first + lane] = t[lane];
      hits.id[first + lane] = id[lane];
    }
  }

  BOULE_INLINE void find_ids(int ray, std::int32_t* id) const {
    if (uniform_[ray / width]) {
      const std::int32_t same = spheres_.id[slot_of(slot_[ray])];
      for (int lane = 0; lane < width; ++lane) id[lane] = same;
      return;
    }
    for (int lane = 0; lane < width; ++lane) {
      const std::uint32_t slot = slot_of(slot_[ray + lane]);
      id[lane] = slot == no_slot ? -1 : spheres_.id[slot];
    }
  }

  /// W nearest hits, the planes included.
  static void meet_planes(const ExactRays& rays, const PlaneView& planes, double* t,
                          std::int32_t* id) {
    Wide nearest = load(t), primitive = load_as_wide(id);
    for (std::size_t k = 0; k < planes.size; ++k) {
      const PlaneLanes plane = get_plane<OneForAll>(planes, k);
      const Roots roots = solve_robust(rays, plane);
      const WideMask better = roots.hit & (roots.t < nearest);  // spheres have the lower ids
      nearest = select(better, roots.t, nearest);
      primitive = select(better, plane.id, primitive);
    }
    alignas(64) double ids[width];
    store(t, nearest);
    store(ids, primitive);
    for (int lane = 0; lane < width; ++lane) id[lane] = static_cast<std::int32_t>(ids[lane]);
  }

  const RaysInPlace<common>& source_;
  const SphereView& spheres_;
  const BundleRays& rays_;
  float limit_ = 0;
  alignas(64) float limits_[bundle_groups];
  alignas(64) float low_[bundle_size];   ///< bounds of v of the hit, or of the end of the ray: what
  alignas(64) float high_[bundle_size];  ///< lies before low is nearer for certain
  alignas(64) float slot_[bundle_size];  ///< bits; no_slot: no hit
  alignas(64) double t_[bundle_size];    ///< where solved_ equals slot_
  alignas(64) float solved_[bundle_size];
  bool solved_any_[bundle_packets];  ///< some lane's slot may be solved
  bool uniform_[bundle_packets];     ///< all lanes have the same slot
};

}  // namespace boule::BOULE_KERNEL_ISA
