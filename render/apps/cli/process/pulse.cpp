#include "render/apps/cli/process/pulse.h"

#include <algorithm>
#include <csignal>
#include <utility>

namespace boule::cli {
namespace {

/// While it lives, threads are born with all signals blocked.
class BlockedSignals {
 public:
  BlockedSignals() {
    sigset_t all{};
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

Pulse::Pulse(Beat beat) : beat_(std::move(beat)) {
  const BlockedSignals blocked;
  thread_.emplace(1, [this](std::size_t) { run(); });
}

Pulse::~Pulse() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
}

void Pulse::at(Clock::time_point when) {
  {
    const std::lock_guard lock(mutex_);
    if (when >= next_) return;
    next_ = when;
  }
  changed_.notify_one();
}

void Pulse::run() {
  constexpr auto never = Clock::time_point::max();
  std::unique_lock lock(mutex_);
  while (!ending_) {
    const auto now = Clock::now();
    if (next_ <= now) {
      next_ = never;
      lock.unlock();
      const auto wanted = beat_(now);
      lock.lock();
      next_ = std::min(next_, wanted);  // at() may have been called meanwhile
    } else if (next_ == never) {
      changed_.wait(lock);
    } else {
      changed_.wait_until(lock, next_);
    }
  }
}

}  // namespace boule::cli
