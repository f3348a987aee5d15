#include "render/cli/part_run.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "render/cli/interrupt.h"
#include "render/cli/time_span.h"

namespace boule::cli {
/// Takes what the checkpoint holds, if there is one, and begins its first interval.
Status PartRun::load() {
  if (checkpoint_ == nullptr) return std::nullopt;
  const auto loaded = checkpoint_->load(head_, sheet_);
  if (!loaded) return loaded.error();
  resumed_ = loaded.value() ? share() : 0;
  for (const PixelRect& block : head_.blocks) {
    if (is_finished(block)) tell_measured(block);
  }
  due_ = Clock::now() + time_span(checkpoint_->interval());
  return std::nullopt;
}

Status PartRun::run(const std::vector<PixelRect>& blocks) {
  head_.blocks = blocks;
  if (auto bad = load()) return bad;
  for (;;) {
    std::vector<PixelRect> rest;
    for (const PixelRect& block : blocks) {
      if (!is_finished(block)) rest.push_back(block);
    }
    if (rest.empty()) return std::nullopt;
    Status bad = render_some(rest);
    if (bad && !StopGuard::flag()) return bad;
    if (checkpoint_ != nullptr && (StopGuard::flag() || is_due())) {
      if (auto unsaved = save()) return unsaved;
    }
    if (StopGuard::flag()) return Diagnostic::of("rendering was cancelled");
  }
}

/// Renders these blocks until all are done, a signal or limit stops it, or a checkpoint is due.
Status PartRun::render_some(const std::vector<PixelRect>& blocks) {
  LiveProgress& progress = live_.progress();
  const std::uint64_t rays = renderer_.statistics().rays.total();
  progress.begin_pass(blocks.size(), {share(), 1, rays, measured_pixels(blocks)});
  std::atomic<std::size_t> next{0};
  const auto task = [&](BlockTools& tools) {
    for (std::size_t i = next++; i < blocks.size() && !is_due(); i = next++) {
      if (StopGuard::flag()) return;
      const std::uint64_t before = tools.counts().total();
      progress.begin_block();
      if (!render_block(tools, blocks[i], sheet_)) return progress.drop_block();
      progress.end_block(tools.counts().total() - before);
      live_.update(progress.read());
    }
  };
  return renderer_.work(std::cref(task));
}

/// Lines and AOVs first: where all pixels have samples, they are known.
bool PartRun::render_block(BlockTools& tools, const PixelRect& block, PartSheet& sheet) const {
  const int spp = renderer_.options().spp;
  int until = sheet.least_samples(block);
  if (until == 0) find_extras(tools, block, sheet);
  if (sheet.kinds().measured) return tools.measure(block, sheet.measured());
  while (until < spp) {
    if (is_due()) return false;
    until += std::min(spp - until, tools.worthwhile_samples(block));
    if (!tools.render(block, until, sheet.film())) return false;
  }
  return true;
}

void PartRun::find_extras(BlockTools& tools, const PixelRect& block, PartSheet& sheet) const {
  if (sheet.kinds().outline) {
    Outline lines(block);
    tools.find_lines(block, lines);
    sheet.set_lines(block, lines);
  }
  if (sheet.kinds().aovs.any_traced()) {
    AovChannels channels(sheet.kinds().aovs, block);
    tools.find_aovs(block, channels);
    sheet.set_channels(block, channels.release(), block);
  }
}

bool PartRun::is_finished(const PixelRect& block) const {
  return sheet_.is_finished(block, renderer_.options().spp);
}

std::uint64_t PartRun::measured_pixels(const std::vector<PixelRect>& blocks) const {
  std::uint64_t pixels = 0;
  for (const PixelRect& block : blocks) pixels += static_cast<std::uint64_t>(block.area());
  return head_.kinds.measured ? pixels : 0;
}

void PartRun::tell_measured(const PixelRect& block) {
  if (!head_.kinds.measured) return;
  live_.progress().add_measured(noise_so_far(sheet_.measured(), block, renderer_.options().spp));
}

bool PartRun::is_due() const { return Clock::now() >= due_; }

Status PartRun::save() {
  if (auto bad = checkpoint_->save(head_, sheet_)) return bad;
  saved_ = true;
  due_ = Clock::now() + time_span(checkpoint_->interval());
  return std::nullopt;
}

double PartRun::share() const { return sheet_.share(head_.blocks, renderer_.options().spp); }

}  // namespace boule::cli
