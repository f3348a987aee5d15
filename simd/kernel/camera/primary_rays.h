#pragma once

#include <cstddef>
#include <limits>

#include "core/math/ray.h"
#include "core/math/vec.h"
#include "core/optics/cameras.h"
#include "simd/abi/stream.h"
#include "simd/kernel/camera/look_up.h"
#include "simd/lanes/lanes.h"

/// Camera rays, W at a time: computed in double, with the direction rounded to float once.
namespace boule::BOULE_KERNEL_ISA {

/// Stores W rays. The first ones alone store the numbers that all rays of the stream share.
BOULE_INLINE void store_rays(const RayStream& rays, std::size_t first, const Vec3<Wide>& org,
                             const Vec3<Wide>& dir) {
  const bool begins = first < max_width;
  if (begins || !rays.shared.has_origin()) {
    store(rays.org_x + first, org.x);
    store(rays.org_y + first, org.y);
    store(rays.org_z + first, org.z);
  }
  if (begins || !rays.shared.has_direction()) {
    store(rays.dir_x + first, narrow(dir.x));
    store(rays.dir_y + first, narrow(dir.y));
    store(rays.dir_z + first, narrow(dir.z));
  }
  if (begins || !rays.shared.has_start()) {
    store(rays.tmin + first, Real(0.0F));
    store(rays.source + first, Bits(no_primitive));
    __builtin_memset(rays.inside + first, 0, width);
  }
  store(rays.tmax + first, Real(std::numeric_limits<float>::infinity()));
}

/// The rays of all samples of a camera: for visit_camera().
struct PrimaryRays {
  const CameraView& camera;
  const SampleStream& samples;
  const RayStream& rays;

  template <class Formula>
  BOULE_INLINE void operator()(Formula) const {
    for (std::size_t first = 0; first < samples.size; first += width) {
      CameraSampleOf<Wide> sample{{load(samples.raster_x + first), load(samples.raster_y + first)}};
      if constexpr (has_lens(Formula::kind)) {
        sample.lens_x = load(samples.lens_x + first);
        sample.lens_y = load(samples.lens_y + first);
      }
      const CameraRayOf<Wide> made = Formula::of(camera, sample);
      store_rays(rays, first, made.org, made.dir);
      if (camera.weighs) store(samples.weight + first, narrow(made.weight));
    }
  }
};

BOULE_INLINE void primary_rays(const CameraView& camera, const SampleStream& samples,
                               const RayStream& rays) {
  visit_camera(camera.kind, PrimaryRays{camera, samples, rays});
}

}  // namespace boule::BOULE_KERNEL_ISA
