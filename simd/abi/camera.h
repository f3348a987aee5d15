#pragma once

#include "core/scene/camera_kind.h"

namespace boule {

/// One surface of a lens, and boxes of its exit pupil: see LensElement, PupilBox, PupilRing.
struct LensElementView {
  double radius, place, aperture2, eta;
};
struct PupilBoxView {
  double x0, x1, y;
};
struct PupilRingView {
  PupilBoxView inner, outer;
};

/// A lens ready to be traced, as plain numbers: see LensOptics. One ring or more, for a camera that
/// has a lens.
struct LensView {
  const LensElementView* elements;  ///< from the film to the scene
  int element_count;
  const PupilRingView* pupil;  ///< from the film's middle
  int ring_count;
  double rings_per_length, rear, film, half_width, half_height, scale, exposure;
};

/// A camera as plain numbers, all in double. With an ST map, the raster point is first moved to
/// (s extent_x, (1 - t) extent_y). With the film point
///   x = (raster_x * scale_x + offset_x) / extent_x,  y likewise,
/// and the vector p = x right + y up:
///   perspective: org = eye,      dir = unit(forward + p)
///   parallel:    org = eye + p,  dir = forward
///   equidistant: org = eye,      dir = cos |p| forward + sin |p| / |p| p;  no ray where |p| > pi
///   thin lens:   org = eye + o,  dir = unit(forward + p - o inverse_focus)
///   lens:        what comes out of its elements in the lens' space, whose axes are right, up and
///                -forward, in units of `scale`, with the eye as its origin
/// where o = a lens_right + b lens_up, and the lens sample stands for (a, b) in the unit disc by
/// Shirley and Chiu, "A low distortion map between disk and square", Journal of Graphics Tools
/// 2(3), 1997.
struct CameraView {
  double eye[3];
  double forward[3];
  double right[3];
  double up[3];
  double lens_right[3];
  double lens_up[3];
  double inverse_focus;
  LensView lens;
  double scale_x, offset_x, extent_x;
  double scale_y, offset_y, extent_y;
  const float* map;  ///< s, t of each pixel of an ST map, or null: see DistortionMap
  int map_width, map_height;
  CameraKind kind;
  bool weighs;  ///< not every sample has a ray that counts 1: weights are written
};

/// Whether a camera reads lens samples.
inline constexpr bool has_lens(CameraKind kind) {
  return kind == CameraKind::thin_lens || kind == CameraKind::lens;
}

}  // namespace boule
