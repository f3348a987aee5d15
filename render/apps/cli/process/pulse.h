#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

#include "render/threads/threads.h"

namespace boule::cli {

/// Calls a function at set times, on a thread of its own. The thread takes no signals, and the
/// pulse uses none: it works whatever signals the parent process has blocked. Where the thread
/// cannot be created the function is never called: its owner must look at the clock elsewhere as
/// well.
class Pulse {
 public:
  using Clock = std::chrono::steady_clock;

  /// The function: gets the time, and returns when it is to be called again; never is
  /// Clock::time_point::max(). Must not throw.
  using Beat = std::function<Clock::time_point(Clock::time_point now)>;

  /// The first beat comes when at() asks for it.
  explicit Pulse(Beat beat);
  /// No beat comes after it.
  ~Pulse();
  Pulse(const Pulse&) = delete;
  Pulse& operator=(const Pulse&) = delete;

  /// Makes the next beat come at `when` at the latest. Not to be called by the beat itself.
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
