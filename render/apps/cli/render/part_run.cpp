#include "render/apps/cli/render/part_run.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "render/apps/cli/process/interrupt.h"
#include "render/apps/cli/process/time_span.h"

namespace boule::cli {

/// Takes what the checkpoint holds, if there is one.
Status PartRun::load() {
  if (checkpoint_ == nullptr) return {};
  const auto loaded = checkpoint_->load(head_, sheet_);
  if (!loaded) return loaded.error();
  resumed_ = loaded.value() ? share() : 0;
  for (const PixelRect& block : head_.blocks) {
    if (is_finished(block)) tell_measured(block);
  }
  return {};
}

/// The first one, or the next one.
void PartRun::begin_interval() {
  if (checkpoint_ != nullptr) due_ = Clock::now() + time_span(checkpoint_->interval());
}

void PartRun::show_every(double seconds, std::function<void()> show) {
  show_interval_ = seconds;
  show_ = std::move(show);
}

/// Replaces what it is time for: the checkpoint, and the picture as far as it is.
Status PartRun::write_due() {
  const auto begin = Clock::now();
  if (begin >= show_due_) {
    show_();
    show_due_ = Clock::now() + time_span(show_interval_);
  }
  auto saved = begin >= due_ ? save() : Status();
  // At least as long as writing took, the picture goes on.
  const auto end = Clock::now();
  due_ = std::max(due_, end + (end - begin));
  show_due_ = std::max(show_due_, end + (end - begin));
  return saved;
}

Status PartRun::run(const std::vector<PixelRect>& blocks) {
  head_.blocks = blocks;
  if (auto done = load(); !done) return done;
  if (auto done = shows_ ? begin_shown() : Status(); !done) return done;
  begin_interval();
  if (show_) show_due_ = Clock::now() + time_span(show_interval_);
  const int spp = renderer_.options().spp;
  const bool at_once = !shows_ || head_.kinds.measured;
  const LivePasses passes(at_once ? PixelOrder::tiles : head_.order, renderer_.rect(), spp);
  int least = spp;
  for (const PixelRect& block : blocks) least = std::min(least, sheet_.least_samples(block));
  double begin = 0;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const LivePass pass = passes[i];
    if (pass.until > least || at_once) {
      if (auto done = run_pass(pass, begin); !done) return done;
    }
    begin = pass.share;
  }
  return {};
}

/// What a picture that is stopped has in any case: lines and AOVs; and where pixels are measured
/// one by one, a sample of each of the others.
Status PartRun::begin_shown() {
  std::vector<PixelRect> rest, empty;
  for (const PixelRect& block : head_.blocks) {
    if (!is_finished(block)) rest.push_back(block);
    if (sheet_.least_samples(block) == 0) empty.push_back(block);
  }
  const auto extras = [this](BlockTools& tools, const PixelRect& block) {
    find_extras(tools, block, sheet_);
    return true;
  };
  const auto one_sample = [this](BlockTools& tools, const PixelRect& block) {
    return tools.render(block, 1, preview_);
  };
  const LiveProgress::PassSpan none{share(), share()};
  if (auto done = render_some(empty, none, extras); !done) return done;
  if (head_.kinds.measured && !StopGuard::flag()) {
    preview_.restart(sheet_.rect());
    if (auto done = render_some(rest, none, one_sample); !done) return done;
  }
  return StopGuard::flag() ? save_stopped() : Status();
}

/// `begin` is the share of the samples that the passes before have.
Status PartRun::run_pass(const LivePass& pass, double begin) {
  const auto task = [this, &pass](BlockTools& tools, const PixelRect& block) {
    return render_block(tools, block, pass, sheet_);
  };
  for (;;) {
    std::vector<PixelRect> rest;
    for (const PixelRect& block : head_.blocks) {
      if (!has(block, pass)) rest.push_back(block);
    }
    if (rest.empty()) return {};
    const double done = std::max(share(), begin);
    const Status ended =
        render_some(rest, {done, std::max(pass.share, done), 0, measured_pixels(rest)}, task);
    if (!ended && !StopGuard::flag()) return ended;
    if (StopGuard::flag()) return save_stopped();
    if (auto saved = write_due(); !saved) return saved;
  }
}

/// The error of a run that was stopped; another one if the checkpoint could not be replaced.
Status PartRun::save_stopped() {
  if (checkpoint_ != nullptr) {
    if (auto saved = save(); !saved) return saved;
  }
  return Diagnostic::of("rendering was cancelled");
}

/// Works on these blocks until all are done, a signal or limit stops it, or a checkpoint is due.
Status PartRun::render_some(const std::vector<PixelRect>& blocks,
                            const LiveProgress::PassSpan& span, const BlockTask& task) {
  if (blocks.empty()) return {};
  LiveProgress& progress = live_.progress();
  LiveProgress::PassSpan traced = span;
  traced.rays = renderer_.statistics().rays.total();
  progress.begin_pass(blocks.size(), traced);
  std::atomic<std::size_t> next{0};
  const auto work = [&](BlockTools& tools) {
    for (std::size_t i = next++; i < blocks.size() && !is_due(); i = next++) {
      if (StopGuard::flag()) return;
      const std::uint64_t before = tools.counts().total();
      progress.begin_block();
      if (!task(tools, blocks[i])) return progress.drop_block();
      progress.end_block(tools.counts().total() - before);
      live_.update(progress.read());
    }
  };
  return renderer_.work(std::cref(work));
}

bool PartRun::render_block(BlockTools& tools, const PixelRect& block, PartSheet& sheet) const {
  LivePass all;
  all.until = renderer_.options().spp;
  return render_block(tools, block, all, sheet);
}

/// Lines and AOVs first: where all pixels have samples, they are known.
bool PartRun::render_block(BlockTools& tools, const PixelRect& block, const LivePass& pass,
                           PartSheet& sheet) const {
  LivePass part = pass;
  part.until = sheet.least_samples(block, pass.pick);
  if (part.until == 0 && !shows_) find_extras(tools, block, sheet);
  if (sheet.kinds().measured) return tools.measure(block, sheet.measured());
  while (part.until < pass.until) {
    if (is_due()) return false;
    part.until += std::min(pass.until - part.until, tools.worthwhile_samples(block));
    if (!tools.render(block, part, sheet.film())) return false;
  }
  return true;
}

bool PartRun::has(const PixelRect& block, const LivePass& pass) const {
  return head_.kinds.measured ? is_finished(block)
                              : sheet_.least_samples(block, pass.pick) >= pass.until;
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

bool PartRun::is_due() const { return Clock::now() >= std::min(due_, show_due_); }

Status PartRun::save() {
  if (auto done = checkpoint_->save(head_, sheet_); !done) return done;
  saved_ = true;
  begin_interval();
  return {};
}

double PartRun::share() const {
  const std::uint64_t all = sheet_.all(head_.blocks, renderer_.options().spp);
  return all > 0 ? static_cast<double>(sheet_.done()) / static_cast<double>(all) : 0;
}

}  // namespace boule::cli
