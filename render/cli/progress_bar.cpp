#include "render/cli/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "render/cli/interrupt.h"
#include "render/cli/messages.h"

namespace boule::cli {
namespace {

/// What there is to tell.
struct Figures {
  double share, elapsed, remaining, mrays_per_s;  ///< remaining: negative while unknown
};

Figures figures_of(const Progress& progress, double elapsed) {
  const double share = progress.share;
  const double remaining = share > 0 ? elapsed * (1 - share) / share : -1;
  const double rays = static_cast<double>(progress.rays);
  return {share, elapsed, remaining, elapsed > 0 ? rays / elapsed * 1e-6 : 0};
}

/// "8.4 s", "3:07", "2:03:07".
std::string duration(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::min(seconds, 1e15));
  const long long s = whole % 60, m = whole / 60 % 60, h = whole / 3600;
  return h > 0 ? fmt::format("{}:{:02}:{:02}", h, m, s) : fmt::format("{}:{:02}", m, s);
}

std::string in_words(const Figures& f) {
  const std::string left = f.remaining < 0 ? "?" : duration(f.remaining);
  return fmt::format("{} elapsed, {} left, {:.1f} Mray/s", duration(f.elapsed), left,
                     f.mrays_per_s);
}

/// Rounded down: 100 % is said when all is done.
int percent(const Figures& f) { return static_cast<int>(f.share * 100); }

std::string plain_line(const Figures& f) {
  return fmt::format("boule: {:3} %, {}", percent(f), in_words(f));
}

std::string json_line(const Figures& f) {
  const std::string left = f.remaining < 0 ? "null" : fmt::format("{:.3f}", f.remaining);
  return fmt::format(
      R"({{"share":{:.4f},"elapsed_s":{:.3f},"remaining_s":{},"mrays_per_s":{:.3f}}})",
      std::floor(f.share * 1e4) * 1e-4, f.elapsed, left, f.mrays_per_s);
}

std::string bar_line(const Figures& f) {
  constexpr int cells = 24;
  const auto full = static_cast<std::size_t>(std::clamp(f.share, 0.0, 1.0) * cells);
  const std::string bar = std::string(full, '#') + std::string(cells - full, '.');
  return fmt::format("boule: {:3} % [{}] {}", percent(f), bar, in_words(f));
}

/// Columns of the terminal on standard error, 80 if it does not tell.
std::size_t terminal_columns() {
  winsize size{};
  const bool told = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return told ? size.ws_col : 80;
}

ProgressStyle resolve(ProgressStyle style) {
  if (style != ProgressStyle::automatic) return style;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::plain;
}

}  // namespace

ProgressBar::ProgressBar(ProgressStyle style) : style_(resolve(style)) {}

ProgressBar::~ProgressBar() {
  if (drawn_ == 0) return;
  print_raw("\n");
  set_line_open(false);
}

void ProgressBar::update(const Progress& progress) {
  if (style_ == ProgressStyle::none) return;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  if (!due(progress, elapsed)) return;
  told_ = true;
  told_at_ = elapsed;
  told_share_ = progress.share;
  const Figures figures = figures_of(progress, elapsed);
  if (style_ == ProgressStyle::bar) return draw(bar_line(figures));
  print_note(style_ == ProgressStyle::json ? json_line(figures) : plain_line(figures));
}

bool ProgressBar::due(const Progress& progress, double elapsed) const {
  if (progress.share >= 1) return told_share_ < 1;
  if (style_ != ProgressStyle::plain) return !told_ || elapsed - told_at_ >= 0.1;
  return std::floor(progress.share * 10) > std::floor(told_share_ * 10) || elapsed - told_at_ >= 10;
}

/// Rewrites the line; what is left of a longer one is blanked.
void ProgressBar::draw(std::string line) {
  line.resize(std::min(line.size(), terminal_columns() - 1));
  const std::size_t length = line.size();
  if (length < drawn_) line.append(drawn_ - length, ' ');
  // First: a signal in between then ends an empty line, not none.
  set_line_open(true);
  print_raw("\r" + line);
  drawn_ = length;
}

}  // namespace boule::cli
