#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "simd/abi/shading.h"
#include "simd/kernel/search/ray_lanes.h"
#include "simd/kernel/vectors.h"

/// Shadow rays from many points to one light, W at a time: those that face it, side by side.
namespace boule::BOULE_KERNEL_ISA {

/// The unit directions to a light, and the shadow rays' own.
struct ToLight {
  Vec3<Wide> unit;
  Vec3<Real> way;
};

/// As segment() in core/math/ray.h has it: the end itself is not met.
inline constexpr float point_tmax = 1 - 4 * 0x1p-24F;

template <bool directional>
BOULE_INLINE ToLight to_light(const LightPlace& light, const Vec3<Wide>& point,
                              const Vec3<Wide>& org) {
  const Vec3<Wide> place{light.place[0], light.place[1], light.place[2]};
  if constexpr (directional) {
    return {place, {light.way[0], light.way[1], light.way[2]}};
  } else {
    return {unit(place - point), narrow(place - org)};
  }
}

template <bool directional>
BOULE_INLINE std::size_t aim_at(const LightPlace& light, const LitStream& points,
                                const AimedStream& aimed) {
  const RayStream& rays = aimed.rays;
  const VectorStream orgs{rays.org_x, rays.org_y, rays.org_z};
  constexpr float tmax = directional ? std::numeric_limits<float>::infinity() : point_tmax;
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
    store_chosen(rays.dir_x + count, to.way.x, chosen);
    store_chosen(rays.dir_y + count, to.way.y, chosen);
    store_chosen(rays.dir_z + count, to.way.z, chosen);
    store_anywhere(rays.tmin + count, Real(0.0F));
    store_anywhere(rays.tmax + count, Real(tmax));
    store_chosen(aimed.to_light, count, to.unit, chosen);
    store_chosen(aimed.cosine + count, cosine, chosen);
    for (unsigned left = chosen; left != 0; left &= left - 1) {
      const std::size_t point = first + static_cast<std::size_t>(__builtin_ctz(left));
      rays.source[count] = points.id[point];
      rays.inside[count] = points.inside[point];
      aimed.point[count] = static_cast<std::uint32_t>(point);
      ++count;
    }
  }
  return count;
}

BOULE_INLINE std::size_t aim(const LightPlace& light, const LitStream& points,
                             const AimedStream& aimed) {
  return light.directional ? aim_at<true>(light, points, aimed)
                           : aim_at<false>(light, points, aimed);
}

}  // namespace boule::BOULE_KERNEL_ISA
