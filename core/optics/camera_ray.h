#pragma once

#include "core/math/ray.h"
#include "core/optics/cameras.h"

namespace boule {

using CameraSample = CameraSampleOf<double>;

/// The ray of a camera through one sample; with weight 0 there is no ray.
struct CameraRay {
  Ray ray;
  float weight = 1;
};

/// The primary ray of a sample: computed in double, the direction rounded to float once (lecture
/// "Cameras", "Pixel centres"). Takes any numbers.
CameraRay camera_ray(const CameraView& camera, const CameraSample& sample);

/// The primary ray through raster point (x, y) and the lens' centre, if there is one.
inline Ray primary_ray(const CameraView& camera, double raster_x, double raster_y) {
  return camera_ray(camera, {{raster_x, raster_y}}).ray;
}

}  // namespace boule
