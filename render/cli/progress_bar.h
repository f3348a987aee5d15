#pragma once

#include <chrono>
#include <string>

#include "render/frame/progress.h"

namespace boule::cli {

/// How progress is told, always on standard error. bar: one line that is rewritten, at most ten
/// times a second. plain: a line every 10 s or 10 %. json: a JSON object a line, at most ten a
/// second: {"share", "elapsed_s", "remaining_s" (null at first), "mrays_per_s"}.
/// automatic: bar on a terminal, else plain.
enum class ProgressStyle { automatic, bar, plain, json, none };

/// Tells how far a pass has come, from its construction on: share, time elapsed, time remaining,
/// and rays per second.
class ProgressBar {
 public:
  explicit ProgressBar(ProgressStyle style);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Ends the bar's line, so that other text starts on one of its own.
  ~ProgressBar();

  void update(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool due(const Progress& progress, double elapsed) const;
  void draw(std::string line);

  ProgressStyle style_;
  Clock::time_point start_ = Clock::now();
  double told_at_ = 0;     ///< seconds from the start; the last time something was told
  double told_share_ = 0;  ///< and the share then
  bool told_ = false;
  std::size_t drawn_ = 0;  ///< length of the line on the terminal
};

}  // namespace boule::cli
