#pragma once

#include <cstdint>

#include "core/math/vec.h"
#include "core/optics/lens_view.h"

namespace boule {

/// The formula that turns the film point (x, y) into a ray: core/optics/cameras.h has one for each
/// kind.
enum class CameraKind : std::uint8_t { pinhole, orthographic, fisheye, thin_lens, lens };

/// Whether a camera uses lens samples.
inline constexpr bool has_lens(CameraKind kind) {
  return kind == CameraKind::thin_lens || kind == CameraKind::lens;
}

/// The map from raster to film coordinates, for one axis: film = (raster * scale + offset) /
/// extent.
struct RasterToFilm {
  double scale, offset, extent;
};

/// A view of the numbers of a DistortionMap; null if there is none.
struct DistortionView {
  const float* st;
  int width, height;
};

/// A camera ready for an image of W x H square pixels, as plain numbers for the kernels.
struct CameraView {
  Vec3d eye;
  Vec3d forward;  ///< L, unit length
  Vec3d right;    ///< u times half the film's width
  Vec3d up;       ///< v times half the film's height
  CameraKind kind;
  bool weighs;  ///< the weights of samples may differ from 1 and are written
  RasterToFilm film_x, film_y;
  Vec3d lens_right, lens_up;  ///< thin lens: u and v times its radius
  double inverse_focus;       ///< thin lens: 1 / distance of the plane in focus
  LensView lens;              ///< lens: its elements
  DistortionView distortion;
};

}  // namespace boule
