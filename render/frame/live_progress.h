#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "render/frame/progress.h"

namespace boule {

/// How far a pass has come, for any thread to read at any time: also while the one that renders is
/// busy with a long block and tells nobody. One thread begins passes, any thread their blocks.
class LiveProgress {
 public:
  /// A pass of so many blocks, above 0, begins: the share begin .. end of all work, after `rays`
  /// rays.
  void begin_pass(std::size_t blocks, double begin, double end, std::uint64_t rays) {
    running_ = 0;
    ended_ = 0;
    rays_ = rays;
    blocks_ = blocks;
    begin_ = begin;
    end_ = end;
  }
  void begin_block() { ++running_; }
  /// A block is done, and took so many rays.
  void end_block(std::uint64_t rays) {
    rays_ += rays;
    ++ended_;
    --running_;
  }
  /// A block was given up: it is not done.
  void drop_block() { --running_; }

  /// Blocks of the pass that are done.
  [[nodiscard]] std::size_t ended() const { return ended_; }

  [[nodiscard]] Progress read() const {
    const double begin = begin_, end = end_;  // first: of a pass that begins now too little is told
    const double done = static_cast<double>(ended_) / static_cast<double>(blocks_);
    return {begin + (end - begin) * done, rays_, running_};
  }

 private:
  std::atomic<double> begin_{0}, end_{1};
  std::atomic<std::size_t> blocks_{1}, running_{0}, ended_{0};
  std::atomic<std::uint64_t> rays_{0};
};

}  // namespace boule
