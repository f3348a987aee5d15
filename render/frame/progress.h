#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace boule {

/// How far the work on pixels or rays has come.
struct Progress {
  double share = 0;         ///< of all work that is done, 0 .. 1
  std::uint64_t rays = 0;   ///< of all kinds, traced so far
  std::size_t running = 0;  ///< blocks that are being worked on; 0 if that is not known
};

/// The progress of rendering, which any thread may read at any time, so also while the rendering
/// thread works on a long block and reports nothing. One thread begins passes; every thread begins
/// and ends its own blocks.
class LiveProgress {
 public:
  /// What a pass covers of all work.
  struct PassSpan {
    double begin = 0, end = 1;  ///< share of the work that is done before and after it
    std::uint64_t rays = 0;     ///< traced before it
  };

  /// Begins a pass of `blocks` blocks. Precondition: blocks > 0.
  void begin_pass(std::size_t blocks, const PassSpan& span) {
    running_ = 0;
    ended_ = 0;
    rays_ = span.rays;
    blocks_ = blocks;
    begin_ = span.begin;
    end_ = span.end;
  }
  void begin_block() { ++running_; }
  /// Ends a block that is done, for which so many rays were traced.
  void end_block(std::uint64_t rays) {
    rays_ += rays;
    ++ended_;
    --running_;
  }
  /// Ends a block that is not done, because it was cancelled.
  void drop_block() { --running_; }

  /// Blocks of the pass that are done.
  [[nodiscard]] std::size_t ended() const { return ended_; }

  [[nodiscard]] Progress read() const {
    // These two first: if a pass begins meanwhile, the share is too small rather than too large.
    const double begin = begin_, end = end_;
    const double done = static_cast<double>(ended_) / static_cast<double>(blocks_);
    return {.share = begin + (end - begin) * done, .rays = rays_, .running = running_};
  }

 private:
  std::atomic<double> begin_{0}, end_{1};
  std::atomic<std::size_t> blocks_{1}, running_{0}, ended_{0};
  std::atomic<std::uint64_t> rays_{0};
};

}  // namespace boule
