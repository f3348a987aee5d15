#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/error.h"
#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/render/checkpoint.h"
#include "render/apps/cli/report/live_report.h"
#include "render/apps/parts/film_file.h"
#include "render/apps/parts/part_sheet.h"
#include "render/frame/film.h"
#include "render/frame/live_passes.h"
#include "render/frame/progress.h"
#include "render/renderer/block_tools.h"
#include "render/renderer/renderer.h"

namespace boule::cli {

/// Renders a picture, or a shard of it, in full: its samples, lines and AOVs. With a checkpoint it
/// goes on from that, replaces it at each interval, and when a StopGuard's flag is raised.
/// A picture that is shown although it was stopped grows in the passes of head.order (LivePasses),
/// after its lines and AOVs; others grow block by block.
class PartRun {
 public:
  /// All must outlive it; `head` is what a film file of the whole picture says, without blocks, and
  /// gets the blocks that are rendered. `checkpoint` may be null.
  PartRun(Renderer& renderer, LiveReport& live, FilmHead& head, const Checkpoint* checkpoint,
          bool shows_unfinished)
      : PartRun(renderer, live, head, checkpoint, renderer.rect()) {
    shows_ = shows_unfinished;
  }
  PartRun(const PartRun&) = delete;
  PartRun& operator=(const PartRun&) = delete;
  virtual ~PartRun() = default;

  /// Calls `show` every so many seconds, between blocks, while the picture grows in passes.
  void show_every(double seconds, std::function<void()> show);

  /// An error if it was cancelled or failed; saved() then tells whether nothing is lost.
  virtual Status run(const std::vector<PixelRect>& blocks);
  /// Whether the error of run() is one, although a StopGuard's flag is raised.
  [[nodiscard]] virtual bool failed() const { return !StopGuard::flag(); }

  [[nodiscard]] PartSheet& sheet() { return sheet_; }
  [[nodiscard]] const PartSheet& sheet() const { return sheet_; }
  /// A sample of each pixel that is to be measured, where the picture is shown unfinished.
  [[nodiscard]] const Film& preview() const { return preview_; }
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
  void begin_interval();
  [[nodiscard]] bool is_finished(const PixelRect& block) const;
  [[nodiscard]] bool is_due() const;
  /// Renders what a block has not yet. False if it was stopped.
  bool render_block(BlockTools& tools, const PixelRect& block, PartSheet& sheet) const;
  bool render_block(BlockTools& tools, const PixelRect& block, const LivePass& pass,
                    PartSheet& sheet) const;
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

  /// Works on a block. False if it was stopped.
  using BlockTask = std::function<bool(BlockTools&, const PixelRect& block)>;
  Status begin_shown();
  Status run_pass(const LivePass& pass, double begin);
  Status render_some(const std::vector<PixelRect>& blocks, const LiveProgress::PassSpan& span,
                     const BlockTask& task);
  Status save_stopped();
  Status write_due();
  [[nodiscard]] bool has(const PixelRect& block, const LivePass& pass) const;
  void find_extras(BlockTools& tools, const PixelRect& block, PartSheet& sheet) const;

  Clock::time_point due_ = Clock::time_point::max();
  Clock::time_point show_due_ = Clock::time_point::max();
  double show_interval_ = 0;  ///< seconds
  std::function<void()> show_;
  double resumed_ = 0;
  bool saved_ = false;
  bool shows_ = false;
  Film preview_{PixelRect{}};
};

}  // namespace boule::cli
