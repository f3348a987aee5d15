#pragma once

#include <cstddef>
#include <limits>

#include "core/math/vec.h"
#include "simd/abi/camera.h"
#include "simd/abi/stream.h"
#include "simd/lanes/lanes.h"

/// Camera rays, W at a time: in double, the direction rounded to float once.
namespace boule::BOULE_KERNEL_ISA {

BOULE_INLINE Vec3<Wide> broadcast(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

BOULE_INLINE void store_ray(const RayStream& rays, std::size_t first, const Vec3<Wide>& org,
                            const Vec3<Wide>& dir) {
  store(rays.org_x + first, org.x);
  store(rays.org_y + first, org.y);
  store(rays.org_z + first, org.z);
  store(rays.dir_x + first, narrow(dir.x));
  store(rays.dir_y + first, narrow(dir.y));
  store(rays.dir_z + first, narrow(dir.z));
  store(rays.tmin + first, Real(0.0F));
  store(rays.tmax + first, Real(std::numeric_limits<float>::infinity()));
  for (int lane = 0; lane < width; ++lane) {
    rays.source[first + static_cast<std::size_t>(lane)] = -1;
    rays.inside[first + static_cast<std::size_t>(lane)] = 0;
  }
}

BOULE_INLINE void primary_rays(const CameraView& camera, const SampleStream& samples,
                               const RayStream& rays) {
  const Vec3<Wide> eye = broadcast(camera.eye), forward = broadcast(camera.forward);
  const Vec3<Wide> right = broadcast(camera.right), up = broadcast(camera.up);
  for (std::size_t first = 0; first < samples.size; first += width) {
    const Wide raster_x = load(samples.raster_x + first), raster_y = load(samples.raster_y + first);
    const Wide x =
        (raster_x * Wide(camera.scale_x) + Wide(camera.offset_x)) / Wide(camera.extent_x);
    const Wide y =
        (raster_y * Wide(camera.scale_y) + Wide(camera.offset_y)) / Wide(camera.extent_y);
    const Vec3<Wide> on_film = right * x + up * y;
    if (camera.parallel) {
      store_ray(rays, first, eye + on_film, forward);
    } else {
      const Vec3<Wide> dir = forward + on_film;
      store_ray(rays, first, eye, dir * (Wide(1.0) / sqrt(dot(dir, dir))));
    }
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
