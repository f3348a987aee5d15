#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "render/apps/cli/process/pulse.h"

namespace boule::cli {

/// The limit that --load-limit sets on the time of reading. When the time is over the program ends
/// at once with an error, even if it is stuck in a system call. Where the thread for this cannot be
/// created, the program ends as soon as the call returns.
class ReadingLimit {
 public:
  /// In seconds; none: no limit.
  explicit ReadingLimit(std::optional<double> limit);

  /// While it lives, a file is being read. One at a time.
  class Reading {
   public:
    Reading(ReadingLimit& limit, const std::string& file);
    /// Ends the program if the time is over by now.
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    ReadingLimit& limit_;
  };

 private:
  using Clock = Pulse::Clock;

  Clock::time_point beat(Clock::time_point now);
  void leave_if_over(Clock::time_point now) const;

  const std::optional<double> limit_;
  std::mutex mutex_;  ///< of all below
  Clock::duration left_;
  std::optional<Clock::time_point> end_;  ///< of the time, while something is read
  std::string error_;           ///< the error's line, made beforehand: it must need no memory
  std::optional<Pulse> pulse_;  ///< last: it uses the others
};

}  // namespace boule::cli
