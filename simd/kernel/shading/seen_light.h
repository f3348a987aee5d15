#pragma once

#include <cstddef>

#include "core/math/light_cone.h"
#include "core/optics/lobes.h"
#include "simd/abi/paths.h"
#include "simd/kernel/shading/going_on.h"
#include "simd/kernel/vectors.h"

/// Light that paths find by their direction alone, W rays at a time.
namespace boule::BOULE_KERNEL_ISA {

/// The weight of light that a path found by its direction, where the direction was chosen with
/// `density` and light sampling would have chosen it with `light_density`.
BOULE_INLINE Wide weight_of_hit(HitWeight weight, const Wide& density, const Wide& light_density) {
  if (weight == HitWeight::full) return 1.0;
  const WideMask found_twice = (Wide(0.0) < density) & (Wide(0.0) < light_density);
  const Wide share =
      weight == HitWeight::none ? Wide(0.0) : power_heuristic(density, light_density);
  return select(found_twice, share, Wide(1.0));
}

/// A filter: false only if the lines of rays certainly miss a sphere. Floats err by some 2^-21 of
/// the way to the centre; the distance of a line from the centre is compared with 1.4 radii and
/// 2^-19 of the way. Squares of directions that are shorter than 2^-20 could be too inexact.
BOULE_INLINE RealMask may_meet(const Vec3<Real>& dir, const Vec3<Real>& to_center, float radius) {
  const Vec3<Real> aside = cross(dir, to_center);
  const Real reach = Real(4 * radius * radius) + Real(0x1p-36F) * dot(to_center, to_center);
  const Real squares = dot(dir, dir);
  return ~((Real(0x1p-40F) < squares) & (squares * reach < dot(aside, aside)));
}

/// The radiance of the sphere lights that rays cross before t.
BOULE_INLINE Vec3<Real> crossed_lights(const SeenLight& seen, const Vec3<Wide>& org,
                                       const Vec3<Real>& dir, const Wide& t, const Real& density) {
  Vec3<Real> sum{0.0F, 0.0F, 0.0F};
  const RealMask chosen = Real(0.0F) < density;
  if (!any(chosen)) return sum;
  for (const LightSphere* light = seen.lights; light != seen.lights + seen.light_count; ++light) {
    const Vec3<Wide> center{light->center[0], light->center[1], light->center[2]};
    const RealMask near =
        chosen & may_meet(dir, narrow(center - org), static_cast<float>(light->radius));
    if (!any(near)) continue;
    const Vec3<Wide> way = widen(dir);
    const Wide size = length(way);
    const LightConeOf<Wide> cone(org, center, light->radius);
    const WideMask met = widen(near) & cone.meets(way * (Wide(1.0) / size), t * size);
    if (!any(met)) continue;
    const Wide weight = weight_of_hit(seen.weight, widen(density),
                                      Wide(seen.sphere_share * light->share) * cone.density());
    const Vec3<Real> radiance{light->radiance[0], light->radiance[1], light->radiance[2]};
    sum = select(narrow(met), sum + radiance * narrow(weight), sum);
  }
  return sum;
}

BOULE_INLINE Vec3<Real> background_of(const SeenBackground& background, const Vec3<Wide>& dir) {
  Vec3<Real> bottom{background.bottom[0], background.bottom[1], background.bottom[2]};
  if (background.kind == SeenBackground::Kind::constant) return bottom;
  const Vec3<Real> top{background.top[0], background.top[1], background.top[2]};
  const Vec3<Wide> up{background.up[0], background.up[1], background.up[2]};
  return gradient_color<Wide>(bottom, top, dot(normalize(dir), up));
}

BOULE_INLINE void see_light(const SeenLight& seen, const SeeingRays& rays) {
  const RayStream& r = rays.rays;
  const bool sees_background = seen.background.kind != SeenBackground::Kind::other;
  for (std::size_t first = 0; first < r.size; first += width) {
    const Vec3<Real> dir = load_directions(r, first);
    Vec3<Real> sum{0.0F, 0.0F, 0.0F};
    if (seen.light_count > 0) {
      const Vec3<Wide> org = load_origins(r, first);
      sum = crossed_lights(seen, org, dir, load(rays.hits.t + first), load(rays.density + first));
    }
    const RealMask missed = load_integers(rays.hits.id + first) == Bits(no_primitive);
    if (sees_background && any(missed))
      sum = select(missed, sum + background_of(seen.background, widen(dir)), sum);
    store(rays.radiance.r + first, sum.x);
    store(rays.radiance.g + first, sum.y);
    store(rays.radiance.b + first, sum.z);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
