#include "render/apps/cli/report/progress_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "render/apps/cli/process/messages.h"

namespace boule::cli {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double patience = 2;   // seconds of silence: of a run on a pipe, of what seems to stand
constexpr double redraw = 0.1;   // seconds, of the bar, and between objects of JSON
constexpr double interval = 10;  // seconds between plain lines
constexpr double step = 10;      // per cent between them

/// "8.4 s", "3:07", "2:03:07".
std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::min(seconds, 1e15));
  const long long s = whole % 60, m = whole / 60 % 60, h = whole / 3600;
  return h > 0 ? fmt::format("{}:{:02}:{:02}", h, m, s) : fmt::format("{}:{:02}", m, s);
}

/// Rounded down: 100 % means that all is done.
int whole_percent(double share) { return static_cast<int>(share * 100); }

std::string json_number(double seconds) {
  return seconds < 0 ? "null" : fmt::format("{:.3f}", seconds);
}

/// The time left after a share of `all` has taken `elapsed`; negative where it is not known.
double extrapolate(double elapsed, double done, double all) {
  return done > 0 ? elapsed * (all - done) / done : -1;
}

}  // namespace

void ProgressBar::start_frame() {
  if (frame_ > 0 && !skipped_) ++rendered_;
  ++frame_;
  skipped_ = false;
  progress_ = {};
}

void ProgressBar::skip_frame() {
  skipped_ = true;
  progress_.share = 1;
  end_stage();
}

void ProgressBar::start_stage(const std::string& what, double now) { stage_ = Stage{what, now}; }

void ProgressBar::start_pass(const char* of_what, double now) {
  end_stage();
  passing_ = true;
  of_what_ = of_what;
  progress_ = {};
  pass_since_ = moved_at_ = now;
  fresh_ = false;
  if (style_ == ProgressStyle::json) told_at_ = told_share_ = -never;
}

/// Ends the line of a single pass: the next pass begins another.
void ProgressBar::end_pass() {
  passing_ = false;
  if (style_ == ProgressStyle::bar && !is_series()) told_at_ = -never;
}

void ProgressBar::update(const Progress& progress, double now) {
  if (!passing_ || progress.share < progress_.share) return;  // told late
  fresh_ = true;
  const bool moved = progress.share != progress_.share || progress.rays != progress_.rays;
  progress_ = progress;
  if (!moved) return;
  moved_at_ = now;
  const double seconds = now - pass_since_;
  millions_per_s_ = seconds > 0 ? static_cast<double>(progress.rays) / seconds * 1e-6 : 0;
}

std::optional<std::string> ProgressBar::tell(double now) {
  if (now < next()) return std::nullopt;
  fresh_ = false;
  told_at_ = now;
  const bool of_stage = stage_ && !(style_ == ProgressStyle::bar && is_series());
  if (of_stage) return stage_line(now);
  told_share_ = share();
  if (style_ == ProgressStyle::json) return json_line(now);
  return style_ == ProgressStyle::bar ? bar_line(now) : plain_line(now);
}

double ProgressBar::next() const {
  switch (style_) {
    case ProgressStyle::bar:
      return next_drawing();
    case ProgressStyle::plain:
      return next_plain_line();
    case ProgressStyle::json:
      if (!passing_ || !fresh_ || told_share_ >= 1) return never;
      return share() < 1 ? told_at_ + redraw : -never;
    default:
      return never;
  }
}

/// A line that has been drawn is redrawn whatever happens; the first one waits for something to
/// tell.
double ProgressBar::next_drawing() const {
  const bool finished = share() >= 1, drawn = told_at_ > -never;
  if (finished && told_share_ < 1) return -never;
  if (stage_) return drawn ? told_at_ + redraw : stage_->since + patience;
  if (finished || !(passing_ || is_series())) return never;
  if (drawn) return told_at_ + redraw;
  if (progress_.share > 0) return -never;
  return passing_ ? pass_since_ + patience : never;
}

double ProgressBar::next_plain_line() const {
  if (stage_) return std::max(stage_->since + patience, told_at_ + interval);
  if (!passing_) return never;
  if (told_share_ < 0) return share() < 1 ? std::max(patience, told_at_ + interval) : never;
  if (share() >= 1) return told_share_ < 1 ? -never : never;
  const bool moved = share() * 100 - told_share_ * 100 > step - 1e-9;
  return moved ? told_at_ + interval : never;
}

/// The share of the series that is done; for programs (json) that of the frame.
double ProgressBar::share() const {
  if (!is_series() || style_ == ProgressStyle::json) return progress_.share;
  return (std::max(frame_ - 1, 0) + progress_.share) / frames_;
}

/// The time left of the series, from the time of the frames that were rendered so far.
double ProgressBar::series_remaining(double now) const {
  const double worked = rendered_ + (skipped_ ? 0 : progress_.share);
  const double left = frames_ - frame_ + 1 - progress_.share;
  return extrapolate(now, worked, worked + left);
}

double ProgressBar::pass_remaining(double now) const {
  const double resumed = progress_.resumed;
  return extrapolate(now - pass_since_, progress_.share - resumed, 1 - resumed);
}

/// "frame 3 of 20, 8.4 s elapsed, 12.1 s left, 3.2 Mray/s", or what it waits for.
std::string ProgressBar::state(double now) const {
  const double left = is_series() ? series_remaining(now) : pass_remaining(now);
  const std::string frame = is_series() ? fmt::format("frame {} of {}, ", frame_, frames_) : "";
  const double elapsed = is_series() ? now : now - pass_since_;
  const std::string so_far = frame + duration(elapsed) + " elapsed, ";
  const std::string what = awaited(now);
  if (left < 0 && !what.empty()) return so_far + what;
  const std::string last = what.empty() ? rate() : what;
  return so_far + (left < 0 ? "?" : duration(left)) + " left" + (last.empty() ? "" : ", " + last);
}

/// What is counted: rays, or points; empty: neither.
std::string_view ProgressBar::counted_things() const {
  const std::string_view of_what = of_what_;
  if (of_what == "spheres") return "";
  return of_what == "points" ? "point" : "ray";
}

/// "3.2 Mray/s"; where noise is measured and pixels are finished, what these have: "38.2 spp, 97 %
/// settled", or "38.2 spp" in a series, whose line has no room for more.
std::string ProgressBar::rate() const {
  const NoiseSoFar& noise = progress_.noise;
  const std::string_view things = counted_things();
  if (things.empty()) return {};
  if (noise.pixels == 0) return fmt::format("{:.1f} M{}/s", millions_per_s_, things);
  const std::string spp = fmt::format("{:.1f} spp", noise.mean_samples());
  return is_series() ? spp
                     : fmt::format("{}, {} % settled", spp, whole_percent(noise.settled_share()));
}

/// "reading a.toml", "waiting for 2 blocks of pixels"; empty while all goes on.
std::string ProgressBar::awaited(double now) const {
  if (stage_) return now - stage_->since >= patience ? stage_->what : "";
  if (!passing_ || progress_.share >= 1) return "";
  const std::string of_what = std::string(" of ") + of_what_;
  const bool stands = now - moved_at_ >= patience;
  if (progress_.share <= 0 && (stands || !is_series()))
    return "waiting for the first block" + of_what;
  if (!stands) return "";
  const std::size_t blocks = progress_.running;
  return "waiting for " + (blocks > 0 ? counted(blocks, "block") : "blocks") + of_what;
}

std::string ProgressBar::stage_line(double now) const {
  const std::string line = "boule: " + stage_->what + " ...";
  return style_ == ProgressStyle::bar ? line + " " + duration(now - stage_->since) : line;
}

std::string ProgressBar::plain_line(double now) const {
  return fmt::format("boule: {:3} %, {}", whole_percent(share()), state(now));
}

/// Made for 80 columns. Where there is little room the text stays and the bar gets shorter.
std::string ProgressBar::bar_line(double now) const {
  constexpr std::size_t columns = 79, others = 16;  // "boule: 100 % [] "
  const std::string text = state(now);
  std::size_t cells = 20;
  for (const std::size_t fewer : {8, 4, 0}) {
    if (others + cells + text.size() > columns) cells = fewer;
  }
  const auto full =
      static_cast<std::size_t>(std::clamp(share(), 0.0, 1.0) * static_cast<double>(cells));
  const std::string bar = std::string(full, '#') + std::string(cells - full, '.');
  return fmt::format("boule: {:3} % {}{}", whole_percent(share()),
                     cells > 0 ? "[" + bar + "] " : "", text);
}

std::string ProgressBar::json_line(double now) const {
  const std::string series = is_series()
                                 ? fmt::format(R"(,"frame":{},"frames":{},"series_remaining_s":{})",
                                               frame_, frames_, json_number(series_remaining(now)))
                                 : "";
  const NoiseSoFar& so_far = progress_.noise;
  const std::string noise =
      so_far.pixels == 0
          ? ""
          : fmt::format(R"(,"mean_spp":{:.2f},"settled":{:.4f})", so_far.mean_samples(),
                        std::floor(so_far.settled_share() * 1e4) * 1e-4);
  const std::string_view things = counted_things();
  const std::string rate =
      things.empty() ? "" : fmt::format(R"(,"m{}s_per_s":{:.3f})", things, millions_per_s_);
  return fmt::format(R"({{"share":{:.4f},"elapsed_s":{:.3f},"remaining_s":{}{}{}{}}})",
                     std::floor(progress_.share * 1e4) * 1e-4, now - pass_since_,
                     json_number(pass_remaining(now)), rate, noise, series);
}

}  // namespace boule::cli
