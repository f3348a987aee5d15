#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/math/geometry.h"
#include "core/math/ray.h"
#include "simd/abi/shading.h"
#include "simd/kernel/search/leaf/ray_lanes.h"
#include "simd/kernel/vectors.h"

/// Shadow rays from many points to one light, W at a time. The rays of points that face the light
/// are stored packed.
namespace boule::BOULE_KERNEL_ISA {

/// The unit directions to a light, and the directions of the shadow rays.
struct ToLight {
  Vec3<Wide> unit;
  Vec3<Real> dir;
};

template <bool directional>
BOULE_INLINE ToLight to_light(const ShadowTarget& light, const Vec3<Wide>& point,
                              const Vec3<Wide>& org) {
  const Vec3<Wide> target{light.target[0], light.target[1], light.target[2]};
  if constexpr (directional) {
    return {target, {light.dir[0], light.dir[1], light.dir[2]}};
  } else {
    return {normalize(target - point), narrow(target - org)};
  }
}

template <bool directional>
BOULE_INLINE std::size_t make_rays(const ShadowTarget& light, const LitStream& points,
                                   const ShadowRayStream& shadows) {
  const RayStream& rays = shadows.rays;
  const VectorStream orgs{rays.org_x, rays.org_y, rays.org_z};
  constexpr float tmax =
      directional ? std::numeric_limits<float>::infinity() : static_cast<float>(short_of_the_end);
  std::size_t count = 0;
  for (std::size_t first = 0; first < points.size; first += width) {
    const WideMask lit = load_set(points.lit + first);
    if (!any(lit)) continue;
    const Vec3<Wide> org = load(points.org, first);
    const ToLight to = to_light<directional>(light, load(points.point, first), org);
    const Wide cosine = dot(load(points.normal, first), to.unit);
    const unsigned chosen = bits(lit & (Wide(0.0) < cosine));
    if (chosen == 0) continue;
    store_chosen(orgs, count, org, chosen);
    store_chosen(rays.dir_x + count, to.dir.x, chosen);
    store_chosen(rays.dir_y + count, to.dir.y, chosen);
    store_chosen(rays.dir_z + count, to.dir.z, chosen);
    store_anywhere(rays.tmin + count, Real(0.0F));
    store_anywhere(rays.tmax + count, Real(tmax));
    store_chosen(shadows.to_light, count, to.unit, chosen);
    store_chosen(shadows.cosine + count, cosine, chosen);
    store_chosen(rays.source + count, load_integers(points.id + first), chosen);
    store_chosen(rays.inside + count, narrow(load_set(points.inside + first)), chosen);
    store_chosen(shadows.point + count, count_from(static_cast<std::uint32_t>(first)), chosen);
    count += static_cast<std::size_t>(count_bits(chosen));
  }
  return count;
}

BOULE_INLINE std::size_t make_shadow_rays(const ShadowTarget& light, const LitStream& points,
                                          const ShadowRayStream& shadows) {
  return light.directional ? make_rays<true>(light, points, shadows)
                           : make_rays<false>(light, points, shadows);
}

}  // namespace boule::BOULE_KERNEL_ISA
