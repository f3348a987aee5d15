#pragma once

#include <cstddef>
#include <cstdint>

#include "render/frame/pixel_rect.h"

namespace boule {

/// A picture as bands of rows from the top, and each band as blocks from left to right and from the
/// top, for a picture that is written while it is rendered. Every pixel is in exactly one block.
class Bands {
 public:
  /// The memory limit, in bytes, for the bands that are in memory at the same time. Two bands of
  /// one row each may exceed it.
  static constexpr std::uint64_t most_bytes = std::uint64_t{20} << 20;

  /// Blocks are `tile` x `tile` pixels, or cut off at the lower edge of a band and at the right
  /// edge. A band has several blocks for each of the workers, if that leaves room for two bands.
  /// Preconditions: `rect` is not empty and its sides are at most 65535; the other arguments are at
  /// least 1.
  Bands(const PixelRect& rect, int tile, unsigned workers, std::size_t pixel_bytes);

  /// The number of bands, and the number in memory at the same time.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t in_memory() const { return in_memory_; }
  /// The pixels of a band. Precondition: band < size().
  [[nodiscard]] PixelRect operator[](std::size_t band) const;

  /// The number of blocks in all bands, and in one.
  [[nodiscard]] std::size_t blocks() const;
  [[nodiscard]] std::size_t blocks_in(std::size_t band) const;
  /// The band of a block, and its pixels. Blocks are counted through all bands. Precondition: block
  /// < blocks().
  [[nodiscard]] std::size_t band_of(std::size_t block) const { return block / blocks_in(0); }
  [[nodiscard]] PixelRect block(std::size_t block) const;

  /// The number of bytes of the bands in memory.
  [[nodiscard]] std::uint64_t bytes() const { return in_memory_ * row_bytes_ * rows_; }

 private:
  PixelRect rect_;
  int tile_;
  std::uint64_t row_bytes_;
  std::uint64_t rows_;  ///< of every band but the last
  std::size_t size_, in_memory_;
};

}  // namespace boule
