#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "render/frame/bands.h"
#include "render/image/image.h"
#include "render/renderer/outline.h"

namespace boule {

/// The bands of a picture that several threads render, while finished ones are handed over in
/// order. The thread that finishes a band hands it over, and the others continue with the next
/// ones. Blocks must begin in their order.
class BandQueue {
 public:
  using Take = std::function<Status(const Image& band)>;

  struct Band {
    PixelRect rect;
    Image image;
    std::optional<Outline> lines;  ///< drawn before the band is handed over
    std::size_t blocks_left = 0;
  };

  /// `bands` and `take` must outlive it. `take` is called by one thread at a time.
  BandQueue(const Bands& bands, Alpha alpha, bool has_lines, const Take& take);

  /// The band of a block, once the block can be rendered. Waits until there is room for it; null
  /// after stop().
  Band* begin(std::size_t block);
  /// Call this when a block is done. Hands over the bands that are complete and next.
  void end(std::size_t block);
  /// Ends all waiting, because some block will never be done. Also called after `take` failed.
  void stop();

  /// The failure of `take`, or std::nullopt.
  [[nodiscard]] Status status() const { return status_; }
  /// The time that threads waited or handed over bands, in seconds, summed over threads.
  /// Precondition: no block is in work.
  [[nodiscard]] double seconds_taken() const { return seconds_taken_; }

 private:
  Band& slot(std::size_t band) { return slots_[band % slots_.size()]; }
  void open_band(std::size_t band);
  [[nodiscard]] bool may_hand_over() const;

  const Bands& bands_;
  const Alpha alpha_;
  const bool has_lines_;
  const Take& take_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::vector<Band> slots_;
  std::size_t opened_ = 0;  ///< bands that have, or had, a slot
  std::size_t taken_ = 0;   ///< bands that were handed over
  bool taking_ = false, stopped_ = false;
  double seconds_taken_ = 0;
  Status status_;
};

}  // namespace boule
