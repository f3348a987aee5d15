#pragma once

#include <algorithm>
#include <optional>

#include "render/renderer/aov_worker.h"
#include "render/renderer/block_worker.h"
#include "render/renderer/outline.h"

namespace boule {

/// The tools of one thread that renders blocks of its own choice (Renderer::work()). Preconditions:
/// a block lies within the frame and within the film or picture it is rendered into; its sides are
/// at most the renderer's options().tile.
class BlockTools {
 public:
  /// All arguments must outlive it.
  BlockTools(const BlockSetup& setup, BlockWorker& worker, const OutlineWorker::Lines& lines)
      : setup_(setup), worker_(worker), lines_(lines) {}

  /// Renders a block until every pixel has `until` samples. Returns false after a cancellation;
  /// then the film lacks some samples, but those it has are whole.
  bool render(const PixelRect& block, int until, Film& film) {
    return worker_.render(block, until, film);
  }
  /// The same for the pixels that a pass picks, and for the samples of that pass.
  bool render(const PixelRect& block, const LivePass& pass, Film& film) {
    return worker_.render(block, pass, film);
  }
  /// Renders a block until its noise, or its edges, are as the options ask. Returns false after a
  /// cancellation; then pixels without samples must be rendered again. Precondition: they ask for
  /// one of the two.
  bool measure(const PixelRect& block, MeasuredPicture& picture) {
    return worker_.measure(block, picture);
  }
  /// Finds the AOVs of a block.
  void find_aovs(const PixelRect& block, AovChannels& channels);
  /// Finds the outline's lines in a block.
  void find_lines(const PixelRect& block, Outline& outline);

  /// The number of samples per pixel of a block that is worth a call of render(): fewer would leave
  /// its streams of rays half empty.
  [[nodiscard]] int worthwhile_samples(const PixelRect& block) const {
    const std::size_t area = std::max<std::size_t>(static_cast<std::size_t>(block.area()), 1);
    return static_cast<int>(std::max<std::size_t>(4 * setup_.stream_size / area, 1));
  }

  /// All rays that this thread traced, and those among them for AOVs and outlines.
  [[nodiscard]] RayCounts counts() const;
  [[nodiscard]] RayCounts extra_counts() const;
  /// The faults of this thread's samples before they entered a film.
  [[nodiscard]] SampleFaults faults() const { return worker_.faults(); }

 private:
  const BlockSetup& setup_;
  BlockWorker& worker_;
  const OutlineWorker::Lines lines_;
  std::optional<AovWorker> aovs_;
  std::optional<OutlineWorker> outline_;
};

}  // namespace boule
