#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

#include "render/threads/threads.h"

namespace boule::cli {

/// Tells what time it is to what waits for it, on a thread of its own that no signal reaches. No
/// signal is used either: what the parent process has blocked does not matter. Where the thread
/// cannot be had nobody is told: what has to happen in time needs another who looks at the clock.
class Pulse {
 public:
  using Clock = std::chrono::steady_clock;

  /// Told the time; returns when it wants to be told again, never: Clock::time_point::max(). Must
  /// not throw.
  using Beat = std::function<Clock::time_point(Clock::time_point now)>;

  /// The first beat comes when at() asks for it.
  explicit Pulse(Beat beat);
  /// No beat comes after it.
  ~Pulse();
  Pulse(const Pulse&) = delete;
  Pulse& operator=(const Pulse&) = delete;

  /// Sees to it that the beat comes then at the latest. Not to be called by the beat itself.
  void at(Clock::time_point when);

 private:
  void run();

  const Beat beat_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Clock::time_point next_ = Clock::time_point::max();
  bool ending_ = false;
  std::optional<Threads> thread_;  ///< last: it uses all the others
};

}  // namespace boule::cli
