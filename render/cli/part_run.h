#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "render/cli/checkpoint.h"
#include "render/cli/interrupt.h"
#include "render/cli/live_report.h"
#include "render/parts/film_file.h"
#include "render/parts/part_sheet.h"
#include "render/renderer/block_tools.h"
#include "render/renderer/renderer.h"

namespace boule::cli {

/// Renders a picture, or a shard of it, in full: its samples, lines and AOVs. With a checkpoint it
/// goes on from that, replaces it at each interval, and when a StopGuard's flag is raised.
class PartRun {
 public:
  /// All must outlive it; `head` is what a film file of the whole picture says, without blocks, and
  /// gets the blocks that are rendered. `checkpoint` may be null.
  PartRun(Renderer& renderer, LiveReport& live, FilmHead& head, const Checkpoint* checkpoint)
      : PartRun(renderer, live, head, checkpoint, renderer.rect()) {}
  PartRun(const PartRun&) = delete;
  PartRun& operator=(const PartRun&) = delete;
  virtual ~PartRun() = default;

  /// An error if it was cancelled or failed; saved() then tells whether nothing is lost.
  virtual Status run(const std::vector<PixelRect>& blocks);
  /// Whether the error of run() is one, although a StopGuard's flag is raised.
  [[nodiscard]] virtual bool failed() const { return !StopGuard::flag(); }

  [[nodiscard]] PartSheet& sheet() { return sheet_; }
  [[nodiscard]] const PartSheet& sheet() const { return sheet_; }
  /// Whether the checkpoint holds all that was done when it was cancelled.
  [[nodiscard]] bool saved() const { return saved_; }
  /// The share of the samples that are done, 0..1.
  [[nodiscard]] double share() const;
  /// The share that the checkpoint held at the start; 0 if there was none.
  [[nodiscard]] double resumed() const { return resumed_; }

 protected:
  /// With a sheet of these pixels only.
  PartRun(Renderer& renderer, LiveReport& live, FilmHead& head, const Checkpoint* checkpoint,
          const PixelRect& sheet_rect)
      : renderer_(renderer),
        live_(live),
        head_(head),
        checkpoint_(checkpoint),
        sheet_(sheet_rect, head.kinds) {}

  Status load();
  [[nodiscard]] bool is_finished(const PixelRect& block) const;
  [[nodiscard]] bool is_due() const;
  /// Renders what a block has not yet. False if it was stopped.
  bool render_block(BlockTools& tools, const PixelRect& block, PartSheet& sheet) const;
  Status save();
  /// How many pixels of the blocks are counted one by one: all where noise is measured, else 0.
  [[nodiscard]] std::uint64_t measured_pixels(const std::vector<PixelRect>& blocks) const;
  /// Tells the noise of a block that was not rendered here.
  void tell_measured(const PixelRect& block);

  Renderer& renderer_;
  LiveReport& live_;
  FilmHead& head_;
  const Checkpoint* checkpoint_;
  PartSheet sheet_;

 private:
  using Clock = std::chrono::steady_clock;

  Status render_some(const std::vector<PixelRect>& blocks);
  void find_extras(BlockTools& tools, const PixelRect& block, PartSheet& sheet) const;

  Clock::time_point due_ = Clock::time_point::max();
  double resumed_ = 0;
  bool saved_ = false;
};

}  // namespace boule::cli
