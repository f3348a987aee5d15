#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/geometry.h"
#include "simd/kernel/plane.h"
#include "simd/kernel/quadratic.h"

/// How primitives come into lanes: one for all rays of a packet, or W for a single ray. A scan is
/// written once over such a source of "steps".
namespace boule::BOULE_KERNEL_ISA {

/// Step i is primitive i in every lane: for packets.
struct OneForAll {
  static constexpr bool one_ray = false;
  static std::size_t steps(std::size_t size) { return size; }
  static std::size_t first_step(std::size_t first) { return first; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) { return values[step]; }
  /// The primitives' places in their arrays.
  BOULE_INLINE static Wide place(std::size_t step) { return static_cast<double>(step); }
  BOULE_INLINE static Wide get(const std::int32_t* ids, std::size_t step) {
    return static_cast<double>(ids[step]);
  }
};

/// Step i is primitives iW .. iW + W - 1, one a lane, the last step padded: for single rays.
struct OnePerLane {
  static constexpr bool one_ray = true;
  static std::size_t steps(std::size_t size) { return (size + width - 1) / width; }
  static std::size_t first_step(std::size_t first) { return first / width; }
  BOULE_INLINE static Real get(const float* values, std::size_t step) {
    return load(values + step * width);
  }
  BOULE_INLINE static Wide place(std::size_t step) {
    return lane_numbers() + Wide(static_cast<double>(step * width));
  }
  BOULE_INLINE static Wide get(const std::int32_t* ids, std::size_t step) {
    return load_as_wide(ids + step * width);
  }
};

template <class Access>
BOULE_INLINE Vec3<Real> sphere_center(const SphereView& s, std::size_t step) {
  return {Access::get(s.center_x, step), Access::get(s.center_y, step),
          Access::get(s.center_z, step)};
}

template <class Access>
BOULE_INLINE SphereLanes get_sphere(const SphereView& s, std::size_t step) {
  return {sphere_center<Access>(s, step), Access::get(s.radius, step), Access::get(s.id, step)};
}

/// The sphere in slot `place` of each lane; any sphere where that is negative.
BOULE_INLINE SphereLanes gather_spheres(const SphereView& s, const Wide& place) {
  alignas(64) double lanes[width], id[width];
  alignas(64) float x[width], y[width], z[width], r[width];
  store(lanes, place);
  for (int lane = 0; lane < width; ++lane) {
    const std::size_t i = lanes[lane] < 0 ? 0 : static_cast<std::size_t>(lanes[lane]);
    x[lane] = s.center_x[i];
    y[lane] = s.center_y[i];
    z[lane] = s.center_z[i];
    r[lane] = s.radius[i];
    id[lane] = s.id[i];
  }
  return {{load(x), load(y), load(z)}, load(r), load(id)};
}

template <class Access>
BOULE_INLINE PlaneLanes get_plane(const PlaneView& p, std::size_t step) {
  return {
      {Access::get(p.point_x, step), Access::get(p.point_y, step), Access::get(p.point_z, step)},
      {Access::get(p.normal_x, step), Access::get(p.normal_y, step), Access::get(p.normal_z, step)},
      Access::place(step) + Wide(static_cast<double>(p.first_id))};
}

}  // namespace boule::BOULE_KERNEL_ISA
