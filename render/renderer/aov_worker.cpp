#include "render/renderer/aov_worker.h"

#include "core/optics/cameras.h"
#include "render/renderer/live_rays.h"

namespace boule {
namespace {

constexpr std::size_t stream_size = 1024;  // rays: few enough to stay in the cache

}  // namespace

AovWorker::AovWorker(const BlockSetup& setup, Solver solver)
    : setup_(setup), tracer_(setup.scene, setup.kernels, solver), aovs_(stream_size) {
  pixels_.reserve(stream_size);
  // Sets the samples' lens points to the centre, where they stay.
  samples_.resize(stream_size, setup.scene.camera_view);
  rays_.resize(stream_size, common_part(setup_.scene.camera_view.kind));
}

void AovWorker::render(const PixelRect& block, AovChannels& channels) {
  for (const PixelOffset& offset : setup_.block_pixels) {
    const int x = block.x0 + offset.x, y = block.y0 + offset.y;
    if (x >= block.x1 || y >= block.y1) continue;
    samples_.set(pixels_.size(), x + 0.5, y + 0.5);
    pixels_.push_back({x, y});
    if (pixels_.size() == stream_size) trace(channels);
  }
  trace(channels);
}

/// Traces the collected rays, and forgets them.
void AovWorker::trace(AovChannels& channels) {
  if (pixels_.empty()) return;
  samples_.resize(pixels_.size());
  const CameraView& camera = setup_.scene.camera_view;
  rays_.resize(pixels_.size(), common_part(camera.kind));
  setup_.kernels.primary_rays(camera, samples_.view(), rays_.view());
  if (camera.weighs) keep_live_rays(samples_, rays_);
  tracer_.trace(rays_, setup_.scene.central_coherence, aovs_.data());
  const Aovs* found = aovs_.data();
  for (std::size_t k = 0; k < pixels_.size(); ++k) {
    const bool has_ray = !camera.weighs || samples_.weight(k) != 0;
    channels.set(pixels_[k].x, pixels_[k].y, has_ray ? *found++ : Aovs{});
  }
  pixels_.clear();
}

}  // namespace boule
