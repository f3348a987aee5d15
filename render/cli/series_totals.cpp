#include "render/cli/series_totals.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/cli/messages.h"

namespace boule::cli {

void SeriesTotals::add(const Stats& frame) {
  ++rendered_;
  work_.work_seconds += frame.work_seconds;
  work_.rays += frame.rays;
  work_.isa = frame.isa;
  work_.threads = std::max(work_.threads, frame.threads);
}

std::string SeriesTotals::text(double seconds) const {
  std::string text = counted(rendered_ + skipped_, "frame");
  if (skipped_ > 0) text += fmt::format(", {} of them there already", skipped_);
  text += fmt::format(", {:.2f} s", seconds);
  if (rendered_ == 0) return text;
  return text + fmt::format(", {:.1f} Mray/s ({}, {})", mrays_per_s(work_), work_.isa,
                            counted(work_.threads, "thread"));
}

}  // namespace boule::cli
