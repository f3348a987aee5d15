#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "render/cli/pulse.h"

namespace boule::cli {

/// What --load-limit asks for: reading may take so long in all, then the program ends at once with
/// an error, also where it is stuck in a call of the system. Where the thread that sees to this
/// cannot be had, it ends when that call has.
class ReadingLimit {
 public:
  /// In seconds; none: nothing here does anything.
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
  std::string error_;           ///< the line then, ready: it may have to do without memory
  std::optional<Pulse> pulse_;  ///< last: it uses the others
};

}  // namespace boule::cli
