#pragma once

#include <cstddef>

#include "simd/abi/geometry.h"
#include "simd/kernel/plane.h"
#include "simd/kernel/quadratic.h"

/// How primitives come into lanes: one for all rays of a packet, or W for a single ray. A scan is
/// written once over such a source of "steps".
namespace boule::BOULE_KERNEL_ISA {

/// Step i is primitive i in every lane: for packets.
struct OneForAll {
  static std::size_t steps(std::size_t size) { return size; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) { return values[step]; }
  BOULE_INLINE static Wide id(std::size_t first_id, std::size_t step) {
    return static_cast<double>(first_id + step);
  }
};

/// Step i is primitives iW .. iW + W - 1, one a lane, the last step padded: for single rays.
struct OnePerLane {
  static std::size_t steps(std::size_t size) { return (size + width - 1) / width; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) {
    return load(values + step * width);
  }
  BOULE_INLINE static Wide id(std::size_t first_id, std::size_t step) {
    return lane_numbers() + Wide(static_cast<double>(first_id + step * width));
  }
};

template <class Access>
BOULE_INLINE Vec3<Real> sphere_center(const SphereView& s, std::size_t step) {
  return {Access::get(s.center_x, step), Access::get(s.center_y, step),
          Access::get(s.center_z, step)};
}

template <class Access>
BOULE_INLINE SphereLanes get_sphere(const SphereView& s, std::size_t step) {
  return {sphere_center<Access>(s, step), Access::get(s.radius, step), Access::id(0, step)};
}

/// Sphere `index` of each lane; any sphere where that is negative.
BOULE_INLINE SphereLanes gather_spheres(const SphereView& s, const Wide& index) {
  alignas(64) double lanes[width];
  alignas(64) float x[width], y[width], z[width], r[width];
  store(lanes, index);
  for (int lane = 0; lane < width; ++lane) {
    const std::size_t i = lanes[lane] < 0 ? 0 : static_cast<std::size_t>(lanes[lane]);
    x[lane] = s.center_x[i];
    y[lane] = s.center_y[i];
    z[lane] = s.center_z[i];
    r[lane] = s.radius[i];
  }
  return {{load(x), load(y), load(z)}, load(r), index};
}

template <class Access>
BOULE_INLINE PlaneLanes get_plane(const PlaneView& p, std::size_t step) {
  return {
      {Access::get(p.point_x, step), Access::get(p.point_y, step), Access::get(p.point_z, step)},
      {Access::get(p.normal_x, step), Access::get(p.normal_y, step), Access::get(p.normal_z, step)},
      Access::id(static_cast<std::size_t>(p.first_id), step)};
}

}  // namespace boule::BOULE_KERNEL_ISA
