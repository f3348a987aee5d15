#include "render/apps/cli/render/team_run.h"

#include <csignal>
#include <cstring>
#include <functional>
#include <string>
#include <utility>

#include "render/frame/stopwatch.h"

namespace boule::cli {
namespace {

RayCounts operator-(const RayCounts& a, const RayCounts& b) {
  return {a.primary - b.primary, a.shadow - b.shadow, a.continuation - b.continuation};
}
SampleFaults operator-(const SampleFaults& a, const SampleFaults& b) {
  return {a.not_finite - b.not_finite, a.too_bright - b.too_bright};
}

}  // namespace

Status TeamRun::run(const std::vector<PixelRect>& blocks) {
  head_.blocks = blocks;
  TeamPicture picture;
  picture.number = number_;
  picture.facts = head_.facts;
  picture.tick = [this] { tick(); };
  if (team_.leads()) {
    if (auto done = load(); !done) {
      failed_ = true;
      return done;
    }
    begin_interval();
    picture.blocks = unfinished(blocks);
    std::vector<PixelRect> rest;
    for (const std::uint32_t number : picture.blocks) rest.push_back(blocks[number]);
    live_.progress().begin_pass(std::max<std::size_t>(rest.size(), 1),
                                {share(), 1, 0, measured_pixels(rest)});
    picture.take = [this, &blocks](std::uint32_t block, std::string_view part) {
      return block < blocks.size() && take(blocks[block], part);
    };
    picture.lost = [this] {
      if (checkpoint_ != nullptr) static_cast<void>(save());
    };
  }
  team_.begin(std::move(picture));
  const auto task = [&](BlockTools& tools) { render(tools, blocks); };
  Status done = renderer_.work(std::cref(task));
  if (!done) team_.stop();
  Status ended = team_.end();
  failed_ = failed_ || !done || (!ended && !StopGuard::flag());
  if (!last_save_) return last_save_;
  if (!done) return done;
  if (ended || checkpoint_ == nullptr) return ended;
  if (auto saved = save(); !saved) {
    failed_ = true;
    return saved;
  }
  return ended;
}

std::vector<std::uint32_t> TeamRun::unfinished(const std::vector<PixelRect>& blocks) const {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!is_finished(blocks[i])) numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return numbers;
}

/// On each thread: whatever the leader hands out.
void TeamRun::render(BlockTools& tools, const std::vector<PixelRect>& blocks) {
  while (const auto number = team_.next_block()) {
    if (*number >= blocks.size()) return;
    const PixelRect& block = blocks[*number];
    const Stopwatch watch;
    const Cost before{tools.counts(), tools.faults()};
    PartSheet sheet(block, head_.kinds);
    if (!render_block(tools, block, sheet)) return;
    const Cost cost{tools.counts() - before.rays, tools.faults() - before.faults};
    std::string part(reinterpret_cast<const char*>(&cost), sizeof cost);
    sheet.append(block, part);
    team_.give(*number, std::move(part), cost.rays.total(), watch.seconds());
  }
}

bool TeamRun::take(const PixelRect& block, std::string_view part) {
  Cost cost;
  const auto pixels = static_cast<std::size_t>(block.area()) * head_.kinds.pixel_bytes();
  if (part.size() != sizeof cost + pixels) return false;
  std::memcpy(&cost, part.data(), sizeof cost);
  if (!sheet_.take(block, part.substr(sizeof cost))) return false;
  cost_.rays += cost.rays;
  cost_.faults += cost.faults;
  live_.progress().begin_block();
  tell_measured(block);
  live_.progress().end_block(cost.rays.total());
  live_.update(live_.progress().read());
  return true;
}

/// On the team's thread, which alone changes the sheet while the ranks render.
void TeamRun::tick() {
  if (team_.leads() && team_.caught() && StopGuard::caught() == 0) ::raise(SIGTERM);
  if (StopGuard::flag()) return team_.stop();
  if (team_.stopped()) {
    failed_ = team_.leads();
    return StopGuard::stop();
  }
  if (checkpoint_ == nullptr || !is_due()) return;
  if (!std::exchange(saves_soon_, true)) return team_.be_patient(600);
  saves_soon_ = false;
  last_save_ = save();
  if (last_save_) return;
  failed_ = true;
  team_.stop();
}

}  // namespace boule::cli
