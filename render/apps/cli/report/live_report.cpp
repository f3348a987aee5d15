#include "render/apps/cli/report/live_report.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/standard_error.h"
#include "render/apps/cli/process/time_span.h"

namespace boule::cli {
namespace {

ProgressStyle style_of(const RunOptions& options) {
  if (options.verbosity == Verbosity::quiet) return ProgressStyle::none;
  if (options.progress != ProgressStyle::automatic) return options.progress;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::plain;
}

}  // namespace

LiveReport::LiveReport(const RunOptions& options, int frames)
    : frames_(frames), bar_(style_of(options), frames) {}

LiveReport::~LiveReport() {
  pulse_.reset();
  end_drawn_line();
}

void LiveReport::start_frame() {
  const std::lock_guard lock(mutex_);
  bar_.start_frame();
}

void LiveReport::skip_frame() {
  const std::lock_guard lock(mutex_);
  bar_.skip_frame();
}

void LiveReport::start_stage(const std::string& what) {
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  bar_.start_stage(what, since_start(now));
  tell_in_time(now);
}

void LiveReport::end_stage() {
  const std::lock_guard lock(mutex_);
  bar_.end_stage();
}

void LiveReport::start_pass(const char* of_what) {
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  progress_.restart();
  bar_.start_pass(of_what, since_start(now));
  tell_in_time(now);
}

/// If another thread is writing at the moment, perhaps to a stopped terminal, the work does not
/// wait.
void LiveReport::update(const Progress& progress) {
  const auto now = Clock::now();
  stop_if_over(now);
  std::unique_lock lock(mutex_, std::defer_lock);
  if (progress.share >= 1) {
    lock.lock();
  } else if (!lock.try_lock()) {
    return;
  }
  bar_.update(progress, since_start(now));
  is_looked_at() ? tell_in_time(now) : tell(now);
}

void LiveReport::end_pass() {
  const std::lock_guard lock(mutex_);
  bar_.end_pass();
  if (!is_series()) end_drawn_line();
}

void LiveReport::end_series() {
  const std::lock_guard lock(mutex_);
  end_drawn_line();
}

void LiveReport::start_time_limit(std::optional<double> seconds) {
  if (!seconds) return;
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  limit_ = now + time_span(*seconds);
  tell_in_time(now);
}

void LiveReport::end_time_limit() {
  const std::lock_guard lock(mutex_);
  limit_ = Clock::time_point::max();
}

void LiveReport::tell_once(const std::string& line, const std::string& varying) {
  std::string key = line;
  for (auto at = key.find(varying); !varying.empty() && at != std::string::npos;
       at = key.find(varying))
    key.erase(at, varying.size());
  if (told_.insert(key).second) write_lines(line + "\n");
}

double LiveReport::seconds() const { return since_start(Clock::now()); }

/// Writes nothing this time if there is no memory.
LiveReport::Clock::time_point LiveReport::beat(Clock::time_point now) noexcept {
  constexpr std::chrono::milliseconds shortest{50}, longest{1000};
  const std::lock_guard lock(mutex_);
  stop_if_over(now);
  try {
    tell(now);
  } catch (const std::exception&) {
  }
  const auto look = is_looked_at() ? now + longest : Clock::time_point::max();
  return std::max(std::min(next(), look), now + shortest);
}

/// To be called under the mutex, as all functions below.
void LiveReport::tell(Clock::time_point now) {
  const double since = since_start(now);
  if (bar_.style() != ProgressStyle::json) bar_.update(progress_.read(), since);
  const auto line = bar_.tell(since);
  if (!line) return;
  bar_.style() == ProgressStyle::bar ? draw_line(*line) : write_lines(*line + "\n");
}

/// Whether a pass goes on whose progress may change without a report.
bool LiveReport::is_looked_at() const {
  const bool told = bar_.style() == ProgressStyle::bar || bar_.style() == ProgressStyle::plain;
  return told && bar_.is_passing();
}

/// Writes what is due, and sets the time of the next beat.
void LiveReport::tell_in_time(Clock::time_point now) {
  tell(now);
  const auto when = next();
  if (when == Clock::time_point::max()) return;
  if (!pulse_) pulse_.emplace([this](Clock::time_point then) { return beat(then); });
  pulse_->at(when);
}

void LiveReport::stop_if_over(Clock::time_point now) {
  if (now < limit_.load()) return;
  limit_ = Clock::time_point::max();
  StopGuard::stop();
}

double LiveReport::since_start(Clock::time_point now) const { return in_seconds(now - start_); }

LiveReport::Clock::time_point LiveReport::next() const {
  const double told = bar_.next();
  const auto limit = limit_.load();
  return std::isinf(told) && told > 0 ? limit : std::min(limit, start_ + time_span(told));
}

}  // namespace boule::cli
