#pragma once

namespace boule {

/// A camera as plain numbers, all in double. With the film point
///   x = (raster_x * scale_x + offset_x) / extent_x,  y likewise,
/// and the vector p = x right + y up:
///   perspective: org = eye,      dir = unit(forward + p)
///   parallel:    org = eye + p,  dir = forward
struct CameraView {
  double eye[3];
  double forward[3];
  double right[3];
  double up[3];
  double scale_x, offset_x, extent_x;
  double scale_y, offset_y, extent_y;
  bool parallel;
};

}  // namespace boule
