#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace boule {

/// The progress of the pixels that have reached their target of noise.
struct NoiseSoFar {
  std::uint64_t pixels = 0;   ///< 0: noise is not measured, or all pixels need more samples
  std::uint64_t samples = 0;  ///< of all of them
  std::uint64_t settled = 0;  ///< pixels with fewer than the largest number of samples

  /// Adds a pixel that has `count` samples, where `most` is the largest number.
  void add(std::uint32_t count, std::uint32_t most) {
    pixels += 1;
    samples += count;
    settled += count < most ? 1 : 0;
  }
  /// The mean number of samples of a pixel, and the fraction of settled pixels. Precondition: there
  /// are pixels.
  [[nodiscard]] double mean_samples() const { return of_pixels(samples); }
  [[nodiscard]] double settled_share() const { return of_pixels(settled); }

  /// `number` divided by the number of pixels.
  [[nodiscard]] double of_pixels(std::uint64_t number) const {
    return static_cast<double>(number) / static_cast<double>(pixels);
  }
};

/// The progress of the work on pixels or rays.
struct Progress {
  double share = 0;         ///< fraction of all work that is done, 0 .. 1
  std::uint64_t rays = 0;   ///< of all kinds, traced so far; of a search near points, these
  std::size_t running = 0;  ///< number of blocks in work; 0 if it is unknown
  NoiseSoFar noise{};
  double resumed = 0;  ///< fraction that an earlier run had done
};

/// The progress of rendering. Any thread may read it at any time, also while the rendering thread
/// works on a long block and reports nothing. One thread begins passes; every thread begins and
/// ends its own blocks.
class LiveProgress {
 public:
  /// The part of all work that a pass covers.
  struct PassSpan {
    double begin = 0, end = 1;  ///< fraction of the work that is done before and after it
    std::uint64_t rays = 0;     ///< traced before it
    std::uint64_t pixels = 0;   ///< of all blocks, if noise is measured; 0: whole blocks count
  };

  /// Forgets all passes. The work before the next pass then counts as done by an earlier run.
  void restart() {
    begin_pass(1, {});
    measured_ = samples_ = settled_ = 0;
    resumed_ = -1;
  }
  /// Begins a pass of `blocks` blocks. Precondition: blocks > 0.
  void begin_pass(std::size_t blocks, const PassSpan& span) {
    running_ = 0;
    ended_ = 0;
    measured_before_ = measured_.load();
    if (resumed_ < 0) resumed_ = span.begin;
    pixels_ = span.pixels;
    rays_ = span.rays;
    blocks_ = blocks;
    begin_ = span.begin;
    end_ = span.end;
  }
  void begin_block() { ++running_; }
  /// Ends a block that is done, for which `rays` rays were traced.
  void end_block(std::uint64_t rays) {
    rays_ += rays;
    ++ended_;
    --running_;
  }
  /// Counts pixels whose noise was measured, in a block that is still in work.
  void add_measured(const NoiseSoFar& noise) {
    measured_ += noise.pixels;  // first, and read last: settled pixels never exceed all pixels
    samples_ += noise.samples;
    settled_ += noise.settled;
  }
  /// Ends a block that was cancelled before its end.
  void drop_block() { --running_; }

  /// The number of blocks of the pass that are done.
  [[nodiscard]] std::size_t ended() const { return ended_; }

  [[nodiscard]] Progress read() const {
    // These two first: if a pass begins in between, the share is too small rather than too large.
    const double begin = begin_, end = end_;
    const std::uint64_t settled = settled_, samples = samples_;
    return {.share = begin + (end - begin) * share_of_pass(),
            .rays = rays_,
            .running = running_,
            .noise = {measured_, samples, settled},
            .resumed = std::max(resumed_.load(), 0.0)};
  }

 private:
  /// By blocks or by pixels, because some blocks take many times as long as others. 1 only after
  /// all blocks have ended.
  [[nodiscard]] double share_of_pass() const {
    constexpr double not_all = 0.9999;
    const std::size_t ended = ended_, blocks = blocks_;
    const std::uint64_t pixels = pixels_;
    if (pixels == 0 || ended >= blocks)
      return static_cast<double>(ended) / static_cast<double>(blocks);
    const std::uint64_t measured = measured_ - measured_before_;
    return std::min(static_cast<double>(measured) / static_cast<double>(pixels), not_all);
  }

  std::atomic<double> begin_{0}, end_{1};
  std::atomic<double> resumed_{-1};  ///< negative: no pass has begun
  std::atomic<std::size_t> blocks_{1}, running_{0}, ended_{0};
  std::atomic<std::uint64_t> rays_{0};
  std::atomic<std::uint64_t> pixels_{0};  ///< of the pass; 0: not counted
  std::atomic<std::uint64_t> measured_{0}, samples_{0}, settled_{0};  ///< as NoiseSoFar
  std::atomic<std::uint64_t> measured_before_{0};                     ///< before the pass
};

}  // namespace boule
