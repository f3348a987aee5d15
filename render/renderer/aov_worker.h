#pragma once

#include <vector>

#include "render/frame/pixel_rect.h"
#include "render/integrators/aovs.h"
#include "render/renderer/aov_channels.h"
#include "render/renderer/block_worker.h"

namespace boule {

/// Finds the AOVs of blocks on one thread: those of the rays through the pixels' centres.
class AovWorker {
 public:
  /// `setup` must outlive it.
  AovWorker(const BlockSetup& setup, Solver solver);

  /// Sets the channels of every pixel of a block.
  void render(const PixelRect& block, AovChannels& channels);

  /// All rays that this worker traced.
  [[nodiscard]] RayCounts counts() const { return tracer_.counts(); }

 private:
  struct Pixel {
    int x, y;
  };
  void trace(AovChannels& channels);

  const BlockSetup& setup_;
  AovTracer tracer_;
  std::vector<Pixel> pixels_;  ///< the pixels of the rays in the stream
  SampleBuffer samples_;
  RayBuffer rays_;
  std::vector<Aovs> aovs_;
};

}  // namespace boule
