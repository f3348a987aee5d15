#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace boule {

/// What is known of the pixels that have as many samples as their noise asks for.
struct NoiseSoFar {
  std::uint64_t pixels = 0;   ///< 0: noise is not measured, or no pixel has them yet
  std::uint64_t samples = 0;  ///< of all of them
  std::uint64_t settled = 0;  ///< those that have fewer than the most samples

  /// Adds a pixel that has so many samples, where so many are the most.
  void add(std::uint32_t count, std::uint32_t most) {
    pixels += 1;
    samples += count;
    settled += count < most ? 1 : 0;
  }
  /// The mean samples of a pixel, and the share that is settled. Precondition: there are pixels.
  [[nodiscard]] double mean_samples() const { return of_pixels(samples); }
  [[nodiscard]] double settled_share() const { return of_pixels(settled); }

  /// `number` for each pixel.
  [[nodiscard]] double of_pixels(std::uint64_t number) const {
    return static_cast<double>(number) / static_cast<double>(pixels);
  }
};

/// How far the work on pixels or rays has come.
struct Progress {
  double share = 0;         ///< of all work that is done, 0 .. 1
  std::uint64_t rays = 0;   ///< of all kinds, traced so far
  std::size_t running = 0;  ///< blocks that are being worked on; 0 if that is not known
  NoiseSoFar noise{};
  double resumed = 0;  ///< the share that was done before the work began, by a run before
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
    std::uint64_t pixels = 0;   ///< of all blocks, where noise is measured; 0: whole blocks count
  };

  /// Forgets all passes. Of the next one, what lies before it was done by a run before.
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
  /// Ends a block that is done, for which so many rays were traced.
  void end_block(std::uint64_t rays) {
    rays_ += rays;
    ++ended_;
    --running_;
  }
  /// Counts pixels whose noise was measured, of a block that is being worked on.
  void add_measured(const NoiseSoFar& noise) {
    measured_ += noise.pixels;  // first, and read last: no more are settled than there are
    samples_ += noise.samples;
    settled_ += noise.settled;
  }
  /// Ends a block that is not done, because it was cancelled.
  void drop_block() { --running_; }

  /// Blocks of the pass that are done.
  [[nodiscard]] std::size_t ended() const { return ended_; }

  [[nodiscard]] Progress read() const {
    // These two first: if a pass begins meanwhile, the share is too small rather than too large.
    const double begin = begin_, end = end_;
    const std::uint64_t settled = settled_, samples = samples_;
    return {.share = begin + (end - begin) * share_of_pass(),
            .rays = rays_,
            .running = running_,
            .noise = {measured_, samples, settled},
            .resumed = std::max(resumed_.load(), 0.0)};
  }

 private:
  /// By blocks, or by pixels, some of which take many times as long as others. 1 only where all
  /// blocks have ended.
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
