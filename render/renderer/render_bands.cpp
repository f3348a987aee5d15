#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <vector>

#include "core/base/float_environment.h"
#include "render/frame/pixel_order.h"
#include "render/frame/stopwatch.h"
#include "render/renderer/band_queue.h"
#include "render/renderer/renderer.h"

/// Rendering in bands, for pictures that are written while they are rendered.
namespace boule {
namespace {

/// Finds the lines of a block in parts of the size that is fastest for the worker.
void find_lines_of(const PixelRect& block, OutlineWorker& worker, Outline& lines) {
  const BlockOrder parts(block, OutlineWorker::block_side, PixelOrder::tiles);
  for (std::size_t i = 0; i < parts.size(); ++i) worker.find(parts[i], lines);
}

}  // namespace

Status Renderer::render_bands(const std::function<Status(const Image&)>& take) {
  if (!scene_) return moved_away();
  const FloatEnvironment environment;
  try {
    const Bands bands = bands_of(options_, scheduler_.workers());
    BandQueue queue(bands, alpha_of(options_), options_.outline > 0, take);
    const double before = render_seconds_;
    Status status = run_bands(bands, queue);
    const double wall = render_seconds_ - before;
    const unsigned threads = scheduler_.threads_used();
    render_seconds_ = before + std::max(wall - queue.seconds_taken() / threads, 0.0);
    if (auto done = queue.status(); !done) return done;
    return status;
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory for the picture");
  }
}

Status Renderer::run_bands(const Bands& bands, BandQueue& queue) {
  const OutlineWorker::Lines lines = outline_lines();
  std::vector<std::unique_ptr<OutlineWorker>> outliners(scheduler_.workers());
  const auto render_block = [&](unsigned index, std::size_t block) {
    BandQueue::Band* const band = queue.begin(block);
    if (band == nullptr) return false;
    const PixelRect rect = bands.block(block);
    if (!worker(index).render(rect, options_.spp, band->image, band->rect)) return false;
    if (band->lines) {
      auto& outliner = outliners[index];
      if (!outliner) outliner = std::make_unique<OutlineWorker>(*setup_, lines);
      find_lines_of(rect, *outliner, *band->lines);
    }
    queue.end(block);
    return true;
  };
  const auto task = [&](unsigned index, std::size_t block) {
    try {
      const bool whole = render_block(index, block);
      if (!whole) queue.stop();
      return whole;
    } catch (...) {
      queue.stop();
      throw;
    }
  };
  Status status = run_indexed(bands.blocks(), std::cref(task), {});
  for (const auto& outliner : outliners) {
    if (outliner) extra_rays_ += outliner->counts();
  }
  return status;
}

}  // namespace boule
