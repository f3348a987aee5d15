#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/base/float_environment.h"
#include "render/frame/live_passes.h"
#include "render/renderer/renderer.h"

/// Rendering in steps, for pictures that are watched and moved.
namespace boule {
namespace {

/// `index` of `count`, with a start at a fraction of them.
std::size_t rotated(std::size_t index, std::size_t count, double by) {
  return (index + static_cast<std::size_t>(by * static_cast<double>(count))) % count;
}

LivePass rotated_pass(const LivePasses& passes, const LivePosition& position) {
  const std::size_t round = passes.interchangeable();
  if (position.pass >= round) return passes[position.pass];
  return passes[rotated(position.pass, round, position.rotated_by)];
}

/// The blocks of orders rows and tiles can begin anywhere.
bool rotates_blocks(PixelOrder order) {
  return order == PixelOrder::rows || order == PixelOrder::tiles;
}

/// The approximate number of pixels of each block that a pass takes.
double taken_share(const PixelPick& pick) {
  return 1.0 / pick.spacing / pick.spacing / pick.slices;
}

}  // namespace

bool Renderer::done(const LivePosition& position) const {
  return position.pass >= LivePasses(options_.order, rect(), options_.spp).size();
}

LivePosition Renderer::restarted(const LivePosition& position) const {
  const LivePasses passes(options_.order, rect(), options_.spp);
  if (options_.order == PixelOrder::progressive || position.pass >= passes.interchangeable())
    return {.rotated_by = position.rotated_by};
  const double in_pass = static_cast<double>(position.block) /
                         static_cast<double>(std::max<std::size_t>(blocks_.size(), 1));
  const double round =
      rotates_blocks(options_.order)
          ? in_pass
          : static_cast<double>(position.pass) / static_cast<double>(passes.interchangeable());
  const double by = position.rotated_by + round;
  return {.rotated_by = by - std::floor(by)};
}

double Renderer::share_done(const LivePosition& position) const {
  const LivePasses passes(options_.order, rect(), options_.spp);
  if (position.pass >= passes.size()) return 1;
  const double before = position.pass == 0 ? 0 : passes[position.pass - 1].share;
  const double in_pass = static_cast<double>(position.block) / static_cast<double>(blocks_.size());
  return before + (passes[position.pass].share - before) * in_pass;
}

Status Renderer::render_step(Film& film, LivePosition& position, const StepLimit& limit) {
  const FloatEnvironment environment;
  if (auto done = check_film(film); !done) return done;
  const Stopwatch watch;
  const LivePasses passes(options_.order, rect(), options_.spp);
  const double block_pixels =
      static_cast<double>(rect().area()) / static_cast<double>(blocks_.size());
  double left = limit.pixels;
  while (position.pass < passes.size()) {
    const LivePass pass = rotated_pass(passes, position);
    const double cost = block_pixels * taken_share(pass.pick);
    const double affordable = std::clamp(left / cost, 1.0, static_cast<double>(blocks_.size()));
    const std::size_t first = position.block;
    const std::size_t end = std::min(first + static_cast<std::size_t>(affordable), blocks_.size());
    if (auto done = run_slice(film, pass, position, {end, watch, limit.seconds}); !done)
      return done;
    left -= cost * static_cast<double>(position.block - first);
    if (position.block == blocks_.size()) {
      ++position.pass;
      position.block = 0;
    }
    if (watch.seconds() >= limit.seconds || !(left >= 1)) break;
  }
  render_seconds_ += watch.seconds();
  return {};
}

/// Renders blocks of a pass from position.block on. A block that has begun is finished.
Status Renderer::run_slice(Film& film, const LivePass& pass, LivePosition& position,
                           const BlockRange& range) {
  const std::size_t first = position.block;
  std::atomic<std::size_t> next{first};
  std::atomic<bool> stopped{false};
  const auto is_over = [&] {
    return next.load() > first && range.watch.seconds() >= range.seconds;
  };
  const auto is_cancelled = [&] { return options_.cancel != nullptr && options_.cancel->load(); };
  const auto body = [&](unsigned index, std::size_t) {
    while (!is_over() && !stopped) {
      const std::size_t block = next.fetch_add(1);
      if (block >= range.end) return;
      const std::size_t at = rotates_blocks(options_.order)
                                 ? rotated(block, blocks_.size(), position.rotated_by)
                                 : block;
      if (is_cancelled() || !worker(index).render(blocks_[at], pass, film)) stopped = true;
    }
  };
  if (auto done = scheduler_.run(scheduler_.workers(), std::cref(body)); !done) return done;
  if (stopped) return Diagnostic::of("rendering was cancelled");
  position.block = std::min(next.load(), range.end);
  return {};
}

}  // namespace boule
