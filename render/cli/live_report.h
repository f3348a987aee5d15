#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "render/cli/options.h"
#include "render/cli/progress_bar.h"
#include "render/cli/pulse.h"
#include "render/frame/progress.h"

namespace boule::cli {

/// What is told on standard error while a run goes on, of however many frames, and the end of its
/// time limit: by one pulse and by what the run itself reports, whoever comes first. Without the
/// pulse's thread there is only the latter.
class LiveReport {
 public:
  /// As loud as the options say; a series of so many frames, 1: none.
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
  /// Leaves the bar's line of a series as it is: other text starts on one of its own.
  void end_series();

  /// What passes keep up to date, if they can: then it is looked at too.
  LiveProgress& progress() { return progress_; }

  /// StopGuard::stop() so many seconds from now, unless end_time_limit() comes first; none: never.
  void start_time_limit(std::optional<double> seconds);
  void end_time_limit();

  /// A line; one that was told before is left out. `place` is what differs from frame to frame in
  /// it, without telling anything new: the scene's name.
  void tell_once(const std::string& line, const std::string& place);

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
