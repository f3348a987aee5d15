#pragma once

#include <span>

#include "core/math/ray.h"
#include "core/scene/camera.h"
#include "core/scene/primitive.h"

namespace boule::reference {

/// The scalar path: the lecture's maths in double, one ray and one primitive at a time, every pair.
/// It shares no code with the kernels and must equal solver `robust` bit for bit. Takes any
/// numbers: what is NaN, infinite or without a direction is a miss. Throws nothing. Preconditions:
/// max_primitives at most; of a camera with a lens its optics, not null.

/// Where a camera is sampled: the raster point, and the lens, 0 .. 1 each, (0.5, 0.5) its centre.
struct CameraSample {
  double raster_x, raster_y;
  double lens_x = 0.5, lens_y = 0.5;
};

/// What a camera sends through a sample; with weight 0 there is no ray.
struct CameraRay {
  Ray ray;
  float weight = 1;
};

/// The primary ray of a sample: computed in double, the direction rounded to float once (lecture
/// "Cameras", "Pixel centres").
CameraRay camera_ray(const CameraBasis& camera, const CameraSample& sample);

/// The primary ray through raster point (x, y) and the lens' centre, if there is one.
inline Ray primary_ray(const CameraBasis& camera, double raster_x, double raster_y) {
  return camera_ray(camera, {raster_x, raster_y}).ray;
}

/// t of the nearest intersection with tmin < t <= tmax, or inf. `leaves` says that the ray starts
/// on this very primitive.
double intersect(const Ray& ray, const Sphere& sphere, bool leaves);
double intersect(const Ray& ray, const Plane& plane, bool leaves);

/// The nearest hit over all; equal t: the lower id. Ids: spheres in order, then planes.
Hit closest_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes);

/// True if anything is met with tmin < t <= tmax.
bool any_hit(const Ray& ray, std::span<const Sphere> spheres, std::span<const Plane> planes);

}  // namespace boule::reference
