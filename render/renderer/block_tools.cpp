#include "render/renderer/block_tools.h"

namespace boule {

void BlockTools::find_aovs(const PixelRect& block, AovChannels& channels) {
  if (!aovs_) aovs_.emplace(setup_, lines_.solver);
  aovs_->render(block, channels);
}

void BlockTools::find_lines(const PixelRect& block, Outline& outline) {
  if (!outline_) outline_.emplace(setup_, lines_);
  const BlockOrder parts(block, OutlineWorker::block_side, PixelOrder::tiles);
  for (std::size_t i = 0; i < parts.size(); ++i) outline_->find(parts[i], outline);
}

RayCounts BlockTools::extra_counts() const {
  RayCounts rays;
  if (aovs_) rays += aovs_->counts();
  if (outline_) rays += outline_->counts();
  return rays;
}

RayCounts BlockTools::counts() const {
  RayCounts rays = worker_.counts();
  return rays += extra_counts();
}

}  // namespace boule
