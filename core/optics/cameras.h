#pragma once

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "core/math/number.h"
#include "core/math/ray.h"
#include "core/optics/camera_view.h"
#include "core/optics/film_point.h"
#include "core/optics/lens_disc.h"
#include "core/optics/lens_rays.h"

namespace boule {

/// The formulas that turn a sample into a ray, one for each kind of camera, for doubles and for
/// lanes of them. A new camera is a new struct here, its kind in CameraKind, a line in
/// visit_camera() and its numbers in build_camera().

/// A sample of a camera: the raster point, and the lens point, 0 .. 1 each, with (0.5, 0.5) as the
/// lens' centre.
template <class T>
struct CameraSampleOf {
  RasterPointOf<T> raster;
  T lens_x = T(0.5), lens_y = T(0.5);
};

/// The ray of a camera through a sample, before its direction is rounded to float, and the weight
/// of its radiance. With weight 0 there is no ray, and its numbers are undefined.
template <class T>
struct CameraRayOf {
  Vec3<T> org, dir;
  T weight = T(1.0);
};

/// The vector p = x right + y up of the film point (x, y), each about -1 .. 1.
template <class T>
BOULE_INLINE Vec3<T> film_vector(const CameraView& camera, const CameraSampleOf<T>& sample) {
  const FilmPointOf<T> film = film_point(camera, sample.raster);
  return vec_cast<T>(camera.right) * film.x + vec_cast<T>(camera.up) * film.y;
}

/// From the eye along unit(forward + p) (lecture "Pinhole camera").
struct PinholeRay {
  static constexpr CameraKind kind = CameraKind::pinhole;
  static constexpr CommonPart common = CommonPart::origin;

  template <class T>
  BOULE_INLINE static CameraRayOf<T> of(const CameraView& camera, const CameraSampleOf<T>& sample) {
    const Vec3<T> p = film_vector(camera, sample);
    return {vec_cast<T>(camera.eye), normalize(vec_cast<T>(camera.forward) + p)};
  }
};

/// From eye + p along forward (lecture "Orthographic camera").
struct OrthographicRay {
  static constexpr CameraKind kind = CameraKind::orthographic;
  static constexpr CommonPart common = CommonPart::direction;

  template <class T>
  BOULE_INLINE static CameraRayOf<T> of(const CameraView& camera, const CameraSampleOf<T>& sample) {
    const Vec3<T> p = film_vector(camera, sample);
    return {vec_cast<T>(camera.eye) + p, vec_cast<T>(camera.forward)};
  }
};

/// From the eye, |p| radians from forward towards p; no ray where |p| > pi (equidistant
/// projection). With h half that angle, sin |p| / |p| = sin h / h cos h and cos |p| = 1 - 2 sin^2
/// h: polynomials in h^2, without a root and smooth in the middle.
struct FisheyeRay {
  static constexpr CameraKind kind = CameraKind::fisheye;
  static constexpr CommonPart common = CommonPart::origin;

  template <class T>
  BOULE_INLINE static CameraRayOf<T> of(const CameraView& camera, const CameraSampleOf<T>& sample) {
    const Vec3<T> p = film_vector(camera, sample);
    const T angle2 = dot(p, p);
    const Mask<T> seen = angle2 <= T(elementary::pi * elementary::pi);
    const T half2 = select(seen, angle2, T(0.0)) * T(0.25);
    const T ratio = elementary::sine_ratio(half2);
    const T along = T(1.0) - T(2.0) * (half2 * (ratio * ratio));
    const T across = ratio * elementary::cosine(half2);
    return {vec_cast<T>(camera.eye), vec_cast<T>(camera.forward) * along + p * across,
            select(seen, T(1.0), T(0.0))};
  }
};

/// From eye + o along unit(forward + p - o / focus), where o is a point of the lens. A thin lens
/// bends all rays from one film point to one point of the plane in focus. The ray through the lens'
/// centre goes straight on, so that point is at forward + p, times the focal distance. Divided by
/// that distance, a sample at the lens' centre gives the pinhole's direction itself.
struct ThinLensRay {
  static constexpr CameraKind kind = CameraKind::thin_lens;
  static constexpr CommonPart common = CommonPart::none;

  template <class T>
  BOULE_INLINE static CameraRayOf<T> of(const CameraView& camera, const CameraSampleOf<T>& sample) {
    const Vec3<T> p = film_vector(camera, sample);
    const DiscPointOf<T> disc = disc_point(sample.lens_x, sample.lens_y);
    const Vec3<T> o =
        vec_cast<T>(camera.lens_right) * disc.x + vec_cast<T>(camera.lens_up) * disc.y;
    const Vec3<T> middle = vec_cast<T>(camera.forward) + p;
    return {vec_cast<T>(camera.eye) + o, normalize(middle - o * T(camera.inverse_focus))};
  }
};

/// The rays of a lens of real elements. The lens' space has right, up and -forward as its axes, the
/// eye as its origin and `scale` as its unit. A lens turns its picture upside down, so the film's
/// coordinates change their signs to compensate.
struct LensCameraRay {
  static constexpr CameraKind kind = CameraKind::lens;
  static constexpr CommonPart common = CommonPart::none;

  template <class T>
  BOULE_INLINE static CameraRayOf<T> of(const CameraView& camera, const CameraSampleOf<T>& sample) {
    const LensView& lens = camera.lens;
    const FilmPointOf<T> film = film_point(camera, sample.raster);
    LensRayOf<T> ray;
    const T weight = send_through(lens, film.x * T(-lens.half_width), film.y * T(-lens.half_height),
                                  sample.lens_x, sample.lens_y, ray);
    return {vec_cast<T>(camera.eye) + to_world(camera, ray.org) * T(lens.scale),
            to_world(camera, ray.dir), weight};
  }

  template <class T>
  BOULE_INLINE static Vec3<T> to_world(const CameraView& camera, const Vec3<T>& v) {
    return vec_cast<T>(camera.right) * v.x + vec_cast<T>(camera.up) * v.y -
           vec_cast<T>(camera.forward) * v.z;
  }
};

/// Calls visit(formula) with the formula of this kind of camera.
template <class Visitor>
BOULE_INLINE constexpr auto visit_camera(CameraKind kind, const Visitor& visit) {
  switch (kind) {
    case CameraKind::orthographic:
      return visit(OrthographicRay{});
    case CameraKind::fisheye:
      return visit(FisheyeRay{});
    case CameraKind::thin_lens:
      return visit(ThinLensRay{});
    case CameraKind::lens:
      return visit(LensCameraRay{});
    case CameraKind::pinhole:
      break;
  }
  return visit(PinholeRay{});
}

/// The part that all primary rays of this kind of camera have in common.
constexpr CommonPart common_part(CameraKind kind) {
  return visit_camera(kind, [](auto formula) { return decltype(formula)::common; });
}

}  // namespace boule
