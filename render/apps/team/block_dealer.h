#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace boule {

/// Hands out the blocks of a picture in portions: large ones first, so that letters are few, single
/// blocks in the end, so that all finish together. A worker has two: the one that it renders, and
/// the next (guided self-scheduling: Polychronopoulos and Kuck, 1987).
class BlockDealer {
 public:
  /// How many blocks a picture has at least for each thread: one costs many times what another
  /// does.
  static constexpr int blocks_each = 64;

  /// Blocks by their numbers; neighbours in the list are neighbours in the picture.
  explicit BlockDealer(const std::vector<std::uint32_t>& blocks);

  /// The next portion for a worker with `threads` of the team's `all_threads`; empty if nothing is
  /// left. Preconditions: 1 <= threads <= all_threads.
  std::vector<std::uint32_t> deal(int threads, int all_threads);

  /// Whether a worker with so many blocks in hand is to get more: it has begun its last portion. Of
  /// the last blocks it gets one when it has none.
  [[nodiscard]] bool wants(std::size_t in_hand, std::size_t last_portion, int threads,
                           int all_threads) const;

  [[nodiscard]] std::size_t left() const { return blocks_.size() - next_; }

 private:
  std::vector<std::uint32_t> blocks_;
  std::size_t next_ = 0;
};

}  // namespace boule
