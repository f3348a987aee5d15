#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "render/apps/cli/options/options.h"
#include "render/apps/cli/process/pulse.h"
#include "render/apps/cli/report/progress_bar.h"
#include "render/frame/progress.h"

namespace boule::cli {

/// Tells on standard error how a run of one frame or more goes on, and ends it at its time limit.
/// It acts at each beat of a pulse and at each report of the run itself; without the pulse's thread
/// only at the latter.
class LiveReport {
 public:
  /// `frames` is the number of frames of a series; 1: no series.
  explicit LiveReport(const RunOptions& options, int frames = 1);
  LiveReport(const LiveReport&) = delete;
  LiveReport& operator=(const LiveReport&) = delete;
  ~LiveReport();

  /// See ProgressBar.
  void start_frame();
  void skip_frame();
  void start_stage(const std::string& what);
  void end_stage();
  void start_pass(const char* of_what);
  void update(const Progress& progress);
  void end_pass();
  /// Leaves the series' bar where it is: other text starts on a line of its own.
  void end_series();

  /// The progress that passes keep up to date, where they can; beats look at it.
  LiveProgress& progress() { return progress_; }

  /// StopGuard::stop() so many seconds from now, unless end_time_limit() comes first; none: never.
  void start_time_limit(std::optional<double> seconds);
  void end_time_limit();

  /// Writes a line unless the same was written before. `varying` is the part that differs from
  /// frame to frame without saying anything new: the scene's name.
  void tell_once(const std::string& line, const std::string& varying);

  [[nodiscard]] bool is_series() const { return frames_ > 1; }
  /// Seconds since the run's start.
  [[nodiscard]] double seconds() const;

 private:
  using Clock = Pulse::Clock;

  Clock::time_point beat(Clock::time_point now) noexcept;
  void tell(Clock::time_point now);
  [[nodiscard]] bool is_looked_at() const;
  void tell_in_time(Clock::time_point now);
  void stop_if_over(Clock::time_point now);
  [[nodiscard]] double since_start(Clock::time_point now) const;
  [[nodiscard]] Clock::time_point next() const;

  const Clock::time_point start_ = Clock::now();
  const int frames_;
  LiveProgress progress_;
  std::set<std::string> told_;  ///< by tell_once()
  std::atomic<Clock::time_point> limit_{Clock::time_point::max()};
  std::mutex mutex_;  ///< of all below
  ProgressBar bar_;
  std::optional<Pulse> pulse_;  ///< last: it uses the others
};

}  // namespace boule::cli
