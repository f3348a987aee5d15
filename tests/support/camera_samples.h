#pragma once

#include <cstddef>
#include <cstdint>

#include "core/optics/camera_ray.h"
#include "core/scene/distortion.h"
#include "simd/stream/stream_buffer.h"
#include "tests/support/case_random.h"

namespace boule::test {

/// Random samples of a camera, over the whole frame and the whole lens.
inline SampleBuffer random_samples(const CameraView& camera, std::size_t count, int width,
                                   int height, std::uint64_t seed) {
  CaseRandom random(seed);
  SampleBuffer samples;
  samples.resize(count, camera);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0, width);
    const double y = random.uniform(0, height);
    samples.set(i, x, y);
    if (!has_lens(camera.kind)) continue;
    const double lens_x = random.uniform();
    const double lens_y = random.uniform();
    samples.set_lens(i, lens_x, lens_y);
  }
  return samples;
}

/// Sample i as the scalar path takes it.
inline CameraSample sample_of(SampleBuffer& samples, const CameraView& camera, std::size_t i) {
  const SampleStream at = samples.view();
  CameraSample sample{{at.raster_x[i], at.raster_y[i]}};
  if (has_lens(camera.kind)) sample.lens_x = at.lens_x[i], sample.lens_y = at.lens_y[i];
  return sample;
}

/// An ST map that moves points by up to `most` of the frame, its own rim included.
inline DistortionMap random_map(int width, int height, double most) {
  CaseRandom random(21);
  DistortionMap map{width, height, {}};
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const double s = random.uniform(-most, most);
      const double t = random.uniform(-most, most);
      map.st.push_back(static_cast<float>((i + 0.5) / width + s));
      map.st.push_back(static_cast<float>(1 - (j + 0.5) / height + t));
    }
  }
  return map;
}

}  // namespace boule::test
