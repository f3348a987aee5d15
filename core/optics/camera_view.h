#pragma once

#include <cstdint>

#include "core/math/vec.h"
#include "core/optics/lens_view.h"

namespace boule {

/// How the film point (x, y) becomes a ray: core/optics/cameras.h has a formula for each.
enum class CameraKind : std::uint8_t { pinhole, orthographic, fisheye, thin_lens, lens };

/// Whether a camera reads lens samples.
inline constexpr bool has_lens(CameraKind kind) {
  return kind == CameraKind::thin_lens || kind == CameraKind::lens;
}

/// From raster to film coordinates, one axis: film = (raster * scale + offset) / extent.
struct RasterToFilm {
  double scale, offset, extent;
};

/// The numbers of a DistortionMap, which live elsewhere; null: there is none.
struct DistortionView {
  const float* st;
  int width, height;
};

/// A camera ready for an image of W x H square pixels, as plain numbers: what kernels read.
struct CameraView {
  Vec3d eye;
  Vec3d forward;  ///< L, unit length
  Vec3d right;    ///< u times half the film's width
  Vec3d up;       ///< v times half the film's height
  CameraKind kind;
  bool weighs;  ///< some samples may not count 1: their weights are written
  RasterToFilm film_x, film_y;
  Vec3d lens_right, lens_up;  ///< thin lens: u and v times its radius
  double inverse_focus;       ///< thin lens: 1 / distance of what is sharp
  LensView lens;              ///< lens: its elements
  DistortionView distortion;
};

}  // namespace boule
