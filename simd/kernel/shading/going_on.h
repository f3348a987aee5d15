#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/optics/reflectance.h"
#include "simd/abi/paths.h"
#include "simd/kernel/search/leaf/ray_lanes.h"
#include "simd/kernel/vectors.h"

/// Rays that leave surfaces, W at a time. The chosen ones are stored packed.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE Vec3<Real> load(const ColorStream& colors, std::size_t first) {
  return {load(colors.r + first), load(colors.g + first), load(colors.b + first)};
}
BOULE_INLINE void store_chosen(const ColorStream& colors, std::size_t first, const Vec3<Real>& c,
                               unsigned chosen) {
  store_chosen(colors.r + first, c.x, chosen);
  store_chosen(colors.g + first, c.y, chosen);
  store_chosen(colors.b + first, c.z, chosen);
}

/// a b, but 0 if a factor is 0: light_product() of render/integrators/sample_faults.h.
BOULE_INLINE Real light_product(const Real& a, const Real& b) {
  const Real zero(0.0F);
  return select((a == zero) | (b == zero), zero, a * b);
}
BOULE_INLINE Vec3<Real> light_product(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {light_product(a.x, b.x), light_product(a.y, b.y), light_product(a.z, b.z)};
}

/// W rays that leave surfaces, from their origins on.
struct LeavingRays {
  Vec3<Wide> org, direction;
  Bits source;
  RealMask inside;
  unsigned chosen;  ///< the lanes with such a ray
};

/// Stores the chosen rays from `at` on, where there is room for W. Returns the index after the last
/// one. The caller sets `tmax`.
BOULE_INLINE std::size_t store_leaving(const RayStream& rays, std::size_t at,
                                       const LeavingRays& leaving) {
  const unsigned chosen = leaving.chosen;
  store_chosen(VectorStream{rays.org_x, rays.org_y, rays.org_z}, at, leaving.org, chosen);
  store_chosen(ColorStream{rays.dir_x, rays.dir_y, rays.dir_z}, at, narrow(leaving.direction),
               chosen);
  store_anywhere(rays.tmin + at, Real(0.0F));
  store_chosen(rays.source + at, leaving.source, chosen);
  store_chosen(rays.inside + at, leaving.inside, chosen);
  return at + static_cast<std::size_t>(count_bits(chosen));
}

/// Appends the chosen ones of W rays to the rays that continue paths.
BOULE_INLINE void add_going_on(const LeavingRays& leaving, const Vec3<Real>& throughput,
                               const Bits& sample, const Real& density, GoingOn& spawned) {
  const std::size_t at = spawned.size;
  spawned.size = store_leaving(spawned.rays, at, leaving);
  store_anywhere(spawned.rays.tmax + at, Real(std::numeric_limits<float>::infinity()));
  store_chosen(spawned.throughput, at, throughput, leaving.chosen);
  store_chosen(spawned.sample + at, sample, leaving.chosen);
  store_chosen(spawned.density + at, density, leaving.chosen);
}

}  // namespace boule::BOULE_KERNEL_ISA
