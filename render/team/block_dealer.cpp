#include "render/team/block_dealer.h"

#include <algorithm>

namespace boule {

std::vector<std::uint32_t> BlockDealer::deal(int threads, int all_threads) {
  constexpr std::size_t rounds = 4;  // of portions, until half is dealt
  const auto mine = static_cast<std::size_t>(threads), all = static_cast<std::size_t>(all_threads);
  const std::size_t fair = left() * mine / (rounds * all);
  const std::size_t count = std::min(std::max(fair, mine), left());
  const auto begin = blocks_.begin() + static_cast<std::ptrdiff_t>(next_);
  next_ += count;
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace boule
