#pragma once

#include <vector>

#include "render/frame/pixel_rect.h"
#include "render/integrators/views.h"
#include "render/renderer/block_worker.h"
#include "render/renderer/view_channels.h"

namespace boule {

/// Finds the views of blocks on one thread: those of the rays through the pixels' centres.
class ViewWorker {
 public:
  /// `setup` must outlive it.
  ViewWorker(const BlockSetup& setup, Solver solver);

  /// Sets every pixel of a block. Throws std::bad_alloc.
  void render(const PixelRect& block, ViewChannels& channels);

  /// All rays traced by this worker.
  [[nodiscard]] RayCounts counts() const { return finder_.counts(); }

 private:
  struct Pixel {
    int x, y;
  };
  void trace(ViewChannels& channels);

  const BlockSetup& setup_;
  Views finder_;
  std::vector<Pixel> pixels_;  ///< whose rays the stream holds
  SampleBuffer samples_;
  RayBuffer rays_;
  std::vector<View> views_;
};

}  // namespace boule
