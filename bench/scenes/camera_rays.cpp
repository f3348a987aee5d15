#include "bench/scenes/camera_rays.h"

#include <bit>
#include <cmath>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "core/optics/cameras.h"
#include "simd/dispatch/dispatch.h"

namespace boule::bench {
namespace {

/// Every second bit of k, from the lowest.
unsigned even_bits(unsigned long long k) {
  unsigned bits = 0;
  for (unsigned bit = 0; bit < 32; ++bit) {
    bits |= static_cast<unsigned>((k >> (2 * bit)) & 1U) << bit;
  }
  return bits;
}

RayBuffer rays_of(const Camera& camera, int side) {
  SampleBuffer samples = pixel_centers(side);
  const CameraView view = build_camera(camera, side, side);
  RayBuffer rays(samples.size(), common_part(view.kind));
  select_kernels("auto").value()->primary_rays(view, samples.view(), rays.view());
  return rays;
}

}  // namespace

SampleBuffer pixel_centers(int side) {
  const auto pixels = static_cast<unsigned>(side);
  const unsigned long long places = 1ULL * std::bit_ceil(pixels) * std::bit_ceil(pixels);
  SampleBuffer samples;
  samples.resize(std::size_t{pixels} * pixels);
  std::size_t next = 0;
  for (unsigned long long k = 0; k < places; ++k) {
    const unsigned x = even_bits(k), y = even_bits(k >> 1);
    if (x < pixels && y < pixels) samples.set(next++, x + 0.5, y + 0.5);
  }
  return samples;
}

RayBuffer primary_rays(const BenchScene& scene, int side) { return rays_of(scene.camera, side); }

RayBuffer parallel_rays(const BenchScene& scene, int side) {
  const CameraPose& pose = scene.camera.pose;
  const double distance = length(vec_cast<double>(pose.look_at) - vec_cast<double>(pose.eye));
  const double half = std::tan(double{scene.camera.fov} * (elementary::pi / 360));
  return rays_of(OrthographicCamera{pose, static_cast<float>(2 * distance * half)}, side);
}

}  // namespace boule::bench
