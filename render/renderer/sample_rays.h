#pragma once

#include <cstddef>
#include <span>

#include "core/math/sample_id.h"
#include "core/optics/camera_view.h"
#include "render/frame/sampler.h"
#include "render/integrators/random_numbers.h"
#include "simd/abi/kernel_table.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

/// Finds the rays of a camera through samples, on one thread. The memory is kept from call to call.
class SampleRays {
 public:
  /// `most`: the largest number of samples of a call. The first three must outlive it.
  SampleRays(const CameraView& camera, const KernelTable& kernels, const Sampler& sampler,
             std::size_t most)
      : camera_(camera), kernels_(kernels), sampler_(sampler), most_(most) {}

  /// Finds the rays of one or more samples. Of a camera that weighs, a ray is undefined where its
  /// sample has the weight 0.
  void find(std::span<const SampleId> ids);

  [[nodiscard]] const SampleBuffer& samples() const { return samples_; }
  RayBuffer& rays() { return rays_; }

 private:
  void place(std::span<const SampleId> ids);
  void find_numbers(std::span<const SampleId> ids, RandomSet set);

  const CameraView& camera_;
  const KernelTable& kernels_;
  const Sampler& sampler_;
  std::size_t most_;
  RandomNumbers numbers_;
  SampleBuffer samples_;
  RayBuffer rays_;
};

}  // namespace boule
