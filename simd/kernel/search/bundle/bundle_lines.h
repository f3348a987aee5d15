#pragma once

#include <cstdint>
#include <limits>

#include "simd/kernel/search/bundle/bundle_discs.h"
#include "simd/kernel/search/bundle/bundle_rays.h"

/// Lines of a bundle's rays against discs of spheres, in lanes: the filters that reject a sphere or
/// bound its root, and the data of the double solver where they cannot decide.
namespace boule::BOULE_KERNEL_ISA {

/// Discs in lanes: the same one in all, or W.
struct DiscLanes {
  Real x, y, z, squared, sure, depth, spread;

  /// Disc k in every lane.
  BOULE_INLINE static DiscLanes same(const Discs& discs, int k) {
    return {discs.x[k],    discs.y[k],     discs.z[k],     discs.squared[k],
            discs.sure[k], discs.depth[k], discs.spread[k]};
  }
  /// W discs, from `at` on.
  BOULE_INLINE static DiscLanes each(const Discs& discs, int at) {
    return {load(discs.x + at),       load(discs.y + at),    load(discs.z + at),
            load(discs.squared + at), load(discs.sure + at), load(discs.depth + at),
            load(discs.spread + at)};
  }
};

/// Rays of a bundle in lanes, as lines: W, or the same one in all.
struct LineLanes {
  Real a, b, c;  ///< c is 0 without a common direction

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

/// Q of filter_bounds.h: negative where a line certainly misses the sphere.
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

/// A lower bound of the first root, in v; NaN where Q < 0.
template <Common common>
BOULE_INLINE Real first_root(const LineLanes& line, const DiscLanes& disc, const Real& q) {
  const Real root = sqrt(q);
  if constexpr (common != Common::direction) {
    return filter_fma(disc.x, line.a, filter_fma(disc.y, line.b, disc.depth)) - root;
  } else {
    return disc.depth - line.c - root;
  }
}

/// The origin that the solver takes: the bundle's, which is in registers, or the ray's own. They
/// are equal, but a zero may differ in its sign, which matters where a sphere lies around the
/// origin.
enum class Origins { bundle, own };

/// Loads W rays of a bundle for the double solver, without a source primitive.
template <Common common, Origins origins = Origins::own>
BOULE_INLINE void load_exact(const PacketRef& packet, const BundleRays& bundle, ExactRays& out) {
  const RayStream& rays = *packet.rays;
  const std::size_t first = packet.first;
  out.org = common == Common::origin && origins == Origins::bundle ? wide_all(bundle.frame.org)
                                                                   : load_origins(rays, first);
  out.dir = widen(load_directions(rays, first));
  out.a = dot(out.dir, out.dir);
  out.inverse_a = Wide(1.0) / out.a;
  const Wide largest(static_cast<double>(std::numeric_limits<float>::max()));
  const Wide tmax = widen(load(rays.tmax + first));
  out.tmin = Wide(0.0);
  out.tmax = select(largest < tmax, largest, tmax);
  out.source = Bits(no_primitive);
  out.inside = widen(uniform(false));
  out.has_source = false;
}

/// The spheres in W slots, without their ids; any sphere where there is no_slot. (Gather
/// instructions are slower.)
template <class Spheres>
BOULE_INLINE SphereLanes gather_slots(const Spheres& s, const std::uint32_t* slots) {
  alignas(64) float x[width], y[width], z[width], r[width];
  for (int lane = 0; lane < width; ++lane) {
    const SlotSphere sphere = get_slot(s, slots[lane] == no_slot ? 0 : slots[lane]);
    x[lane] = sphere.x;
    y[lane] = sphere.y;
    z[lane] = sphere.z;
    r[lane] = sphere.radius;
  }
  return {{load(x), load(y), load(z)}, load(r), Bits(no_primitive)};
}

/// The sphere in one slot, in every lane.
template <class Spheres>
BOULE_INLINE SphereLanes broadcast_slot(const Spheres& s, std::uint32_t slot) {
  const SlotSphere sphere = get_slot(s, slot);
  return {{sphere.x, sphere.y, sphere.z}, sphere.radius, Bits(id_of(s, slot))};
}

/// The first root of spheres that are simple for the bundle and certainly hit: the result of
/// solve_robust() without the tests whose answers are known.
BOULE_INLINE Wide solve_first(const ExactRays& rays, const SphereLanes& sphere) {
  const Vec3<Wide> f = widen(sphere.center) - rays.org;
  const Wide r = widen(sphere.radius);
  const Wide b = dot(f, rays.dir);
  const Vec3<Wide> l = f - rays.dir * (b * rays.inverse_a);
  const Wide discriminant = r * r - dot(l, l);
  return (dot(f, f) - r * r) / (b + sqrt(rays.a * discriminant));
}

}  // namespace boule::BOULE_KERNEL_ISA
