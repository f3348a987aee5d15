#include "render/apps/team/team_ranks.h"

#include <algorithm>

#include "core/base/error.h"

namespace boule {

using Clock = std::chrono::steady_clock;

TeamRanks::TeamRanks(int own, int size, const RankName& name)
    : ranks_(static_cast<std::size_t>(size)), own_(own) {
  for (KnownRank& rank : ranks_) rank.heard = Clock::now();
  ranks_.front().here = true;
  (*this)[own].name = name;
}

std::vector<int> TeamRanks::watched() const {
  if (!leads()) return {0};
  std::vector<int> others;
  for (int number = 1; number < size(); ++number) others.push_back(number);
  return others;
}

std::string TeamRanks::called(int number) const {
  const RankName& name = ranks_[static_cast<std::size_t>(number)].name;
  if (name.process == 0) return "rank " + std::to_string(number);
  return "rank " + std::to_string(number) + " (process " + std::to_string(name.process) + " on " +
         printable(name.host, 64) + ")";
}

int TeamRanks::all_threads() const {
  const int own = ranks_[static_cast<std::size_t>(own_)].name.threads;
  int all = 0;
  for (const KnownRank& rank : ranks_) all += std::max(rank.here ? rank.name.threads : own, 1);
  return all;
}

bool TeamRanks::all_ended() const {
  return std::all_of(begin(), end(), [](const KnownRank& rank) { return rank.ended; });
}

bool TeamRanks::all_compared() const {
  return std::all_of(begin() + 1, end(),
                     [](const KnownRank& rank) { return rank.compared || rank.ended; });
}

std::optional<TeamRanks::Lost> TeamRanks::find_lost(
    double silence, const std::function<bool(const RankName&)>& is_gone) {
  constexpr std::chrono::milliseconds interval{100};
  const auto now = Clock::now();
  if (now - checked_ < interval) return std::nullopt;
  checked_ = now;
  for (const int number : watched()) {
    const KnownRank& rank = (*this)[number];
    if (rank.ended) continue;
    if (rank.name.process != 0 && is_gone && is_gone(rank.name)) {
      // A leader that ends all goes first itself, and has told why.
      if (leads() || ++gone_checks_ > 10) return Lost{number, "is gone"};
    }
    const double silent = std::chrono::duration<double>(now - rank.heard).count();
    if (silent > std::max(rank.patience, silence)) {
      return Lost{number, "has given no sign of life for " +
                              std::to_string(static_cast<int>(silent)) + " s"};
    }
  }
  return std::nullopt;
}

}  // namespace boule
