#include "render/apps/team/block_dealer.h"

#include <algorithm>
#include <bit>

namespace boule {

/// In the order of the reversed bits of their places: any run of them is spread evenly.
BlockDealer::BlockDealer(const std::vector<std::uint32_t>& blocks) {
  const int bits = std::bit_width(blocks.size());
  blocks_.reserve(blocks.size());
  for (std::size_t i = 0; i < std::size_t{1} << bits; ++i) {
    std::size_t place = 0;
    for (int bit = 0; bit < bits; ++bit) place |= (i >> bit & 1) << (bits - 1 - bit);
    if (place < blocks.size()) blocks_.push_back(blocks[place]);
  }
}

bool BlockDealer::wants(std::size_t in_hand, std::size_t last_portion, int threads,
                        int all_threads) const {
  const bool is_end = left() <= static_cast<std::size_t>(all_threads);
  return is_end ? in_hand < static_cast<std::size_t>(threads) : in_hand <= last_portion;
}

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
