#include "bench/camera_rays.h"

#include <bit>

#include "core/optics/camera_builder.h"
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

RayBuffer primary_rays(const BenchScene& scene, int side) {
  SampleBuffer samples = pixel_centers(side);
  RayBuffer rays(samples.size());
  const KernelTable& kernels = *select_kernels("auto").value();
  kernels.primary_rays(build_camera(scene.camera, side, side), samples.view(), rays.view());
  return rays;
}

}  // namespace boule::bench
