#pragma once

#include <cstddef>
#include <limits>

#include "core/math/vec.h"
#include "simd/abi/camera.h"
#include "simd/abi/stream.h"
#include "simd/kernel/camera/film_point.h"
#include "simd/kernel/camera/lens_disc.h"
#include "simd/kernel/camera/lens_stack.h"
#include "simd/kernel/vectors.h"
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

/// W rays of a pinhole or an orthographic camera.
BOULE_INLINE void straight_rays(const CameraView& camera, const SampleStream& samples,
                                const RayStream& rays, std::size_t first) {
  const Vec3<Wide> eye = broadcast(camera.eye), forward = broadcast(camera.forward);
  const FilmPoint film = film_point(camera, samples, first);
  const Vec3<Wide> on_film = broadcast(camera.right) * film.x + broadcast(camera.up) * film.y;
  if (camera.kind == CameraKind::parallel) {
    store_ray(rays, first, eye + on_film, forward);
  } else {
    store_ray(rays, first, eye, unit(forward + on_film));
  }
}

/// W rays of a fisheye. With h half the angle |p| from the view, sin |p| / |p| = sin h / h cos h
/// and cos |p| = 1 - 2 sin^2 h: polynomials in h^2, without a root and smooth in the middle.
BOULE_INLINE void fisheye_rays(const CameraView& camera, const SampleStream& samples,
                               const RayStream& rays, std::size_t first) {
  const FilmPoint film = film_point(camera, samples, first);
  const Vec3<Wide> on_film = broadcast(camera.right) * film.x + broadcast(camera.up) * film.y;
  const Wide angle2 = dot(on_film, on_film);
  const WideMask seen = angle2 <= Wide(elementary::pi * elementary::pi);
  const Wide half2 = select(seen, angle2, Wide(0.0)) * Wide(0.25);
  const Wide ratio = elementary::sine_ratio(half2);
  const Wide along = Wide(1.0) - Wide(2.0) * (half2 * (ratio * ratio));
  const Wide across = ratio * elementary::cosine(half2);
  store_ray(rays, first, broadcast(camera.eye),
            broadcast(camera.forward) * along + on_film * across);
  if (camera.weighs) {
    store(samples.weight + first, narrow(select(seen, Wide(1.0), Wide(0.0))));
  }
}

/// W rays of a thin lens: all that pass it through one film point meet in the plane of focus.
BOULE_INLINE void thin_lens_rays(const CameraView& camera, const SampleStream& samples,
                                 const RayStream& rays, std::size_t first) {
  const FilmPoint film = film_point(camera, samples, first);
  const Vec3<Wide> on_film = broadcast(camera.right) * film.x + broadcast(camera.up) * film.y;
  const DiscPoint disc = disc_point(samples, first);
  const Vec3<Wide> on_lens =
      broadcast(camera.lens_right) * disc.x + broadcast(camera.lens_up) * disc.y;
  const Vec3<Wide> middle = broadcast(camera.forward) + on_film;
  store_ray(rays, first, broadcast(camera.eye) + on_lens,
            unit(middle - on_lens * Wide(camera.inverse_focus)));
}

/// W rays of a lens of real elements. Its picture is upside down: so is the film.
BOULE_INLINE void real_lens_rays(const CameraView& camera, const SampleStream& samples,
                                 const RayStream& rays, std::size_t first) {
  const LensView& lens = camera.lens;
  const FilmPoint film = film_point(camera, samples, first);
  LensRays through;
  const Wide weight =
      lens_rays(lens, film.x * Wide(-lens.half_width), film.y * Wide(-lens.half_height),
                load(samples.lens_x + first), load(samples.lens_y + first), through);
  const Vec3<Wide> right = broadcast(camera.right), up = broadcast(camera.up);
  const Vec3<Wide> forward = broadcast(camera.forward);
  const Vec3<Wide> org = right * through.org.x + up * through.org.y - forward * through.org.z;
  const Vec3<Wide> dir = right * through.dir.x + up * through.dir.y - forward * through.dir.z;
  store_ray(rays, first, broadcast(camera.eye) + org * Wide(lens.scale), dir);
  store(samples.weight + first, narrow(weight));
}

/// The rays of all samples, by one of the functions above.
template <auto rays_of>
BOULE_INLINE void for_each_packet(const CameraView& camera, const SampleStream& samples,
                                  const RayStream& rays) {
  for (std::size_t first = 0; first < samples.size; first += width) {
    rays_of(camera, samples, rays, first);
  }
}

BOULE_INLINE void primary_rays(const CameraView& camera, const SampleStream& samples,
                               const RayStream& rays) {
  switch (camera.kind) {
    case CameraKind::perspective:
    case CameraKind::parallel:
      return for_each_packet<straight_rays>(camera, samples, rays);
    case CameraKind::equidistant:
      return for_each_packet<fisheye_rays>(camera, samples, rays);
    case CameraKind::thin_lens:
      return for_each_packet<thin_lens_rays>(camera, samples, rays);
    case CameraKind::lens:
      return for_each_packet<real_lens_rays>(camera, samples, rays);
  }
}

}  // namespace boule::BOULE_KERNEL_ISA
