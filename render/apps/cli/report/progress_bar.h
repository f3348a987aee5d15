#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "render/apps/cli/options/options.h"
#include "render/frame/progress.h"

namespace boule::cli {

/// Decides what is told of a run while it goes on, and when: the share that is done, the time
/// elapsed and remaining, rays or points per second or, where noise is measured, the samples of
/// finished pixels, and, when nothing moves, what the run waits for. Stages, whose share is not
/// known, are told of when they have taken two seconds, and on a pipe every ten seconds from then
/// on. The class neither looks at a clock nor writes: `now` is in seconds from the run's start and
/// never decreases.
class ProgressBar {
 public:
  /// Any style but automatic. `frames` is the number of frames of a series; 1: no series.
  explicit ProgressBar(ProgressStyle style, int frames = 1) : style_(style), frames_(frames) {}

  /// Begins the next frame of the series. A frame that is skipped does not count in the estimate of
  /// the time that a frame takes.
  void start_frame();
  void skip_frame();

  /// Stage: "reading a.toml"; it ends with the next stage, with a pass or with end_stage().
  void start_stage(const std::string& what, double now);
  void end_stage() { stage_.reset(); }

  /// A pass over blocks of "pixels", "rays", "points" or "spheres", from start to end.
  void start_pass(const char* of_what, double now);
  void update(const Progress& progress, double now);
  void end_pass();
  /// Whether a pass has begun and not ended.
  [[nodiscard]] bool is_passing() const { return passing_; }

  /// The line to be written now, if any, without its end; with style bar it rewrites the one
  /// before.
  std::optional<std::string> tell(double now);

  /// When tell() will have a line if nothing moves until then; infinity: never.
  [[nodiscard]] double next() const;

  [[nodiscard]] ProgressStyle style() const { return style_; }

 private:
  struct Stage {
    std::string what;
    double since;
  };
  [[nodiscard]] bool is_series() const { return frames_ > 1; }
  [[nodiscard]] double share() const;
  [[nodiscard]] double series_remaining(double now) const;
  [[nodiscard]] double pass_remaining(double now) const;
  [[nodiscard]] double next_drawing() const;
  [[nodiscard]] double next_plain_line() const;
  [[nodiscard]] std::string state(double now) const;
  [[nodiscard]] std::string_view counted_things() const;
  [[nodiscard]] std::string rate() const;
  [[nodiscard]] std::string awaited(double now) const;
  [[nodiscard]] std::string stage_line(double now) const;
  [[nodiscard]] std::string plain_line(double now) const;
  [[nodiscard]] std::string bar_line(double now) const;
  [[nodiscard]] std::string json_line(double now) const;

  ProgressStyle style_;
  int frames_;
  int frame_ = 0;     ///< from 1
  int rendered_ = 0;  ///< frames before this one that took their time
  bool skipped_ = false;
  std::optional<Stage> stage_;
  bool passing_ = false;
  const char* of_what_ = "";
  Progress progress_;          ///< of this pass or the last
  double pass_since_ = 0;      ///< its start
  double moved_at_ = 0;        ///< when progress_ changed
  double millions_per_s_ = 0;  ///< of the pass until then
  bool fresh_ = false;         ///< an update came since something was told
  double told_at_ = -std::numeric_limits<double>::infinity();  ///< anything
  double told_share_ = -1;  ///< share() then; negative: none was told yet
};

}  // namespace boule::cli
