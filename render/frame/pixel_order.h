#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/frame/pixel_rect.h"

namespace boule {

/// In which order the blocks of a picture are rendered (lecture "Frame loop"); it never shows in
/// the picture. rows: row by row. tiles: along a Morton curve. progressive: every 2^k-th block
/// first, then those between. frameless: shuffled.
enum class PixelOrder { rows, tiles, progressive, frameless };

inline constexpr int max_tile = 1024;  ///< pixels

/// A rectangle cut into square blocks, in order. Every pixel is in exactly one block.
class BlockOrder {
 public:
  BlockOrder() = default;

  /// Blocks of `tile` x `tile` pixels, 1 .. max_tile (others count as the nearest of these),
  /// clipped at the right and lower edge of `rect`; none where that is empty. Precondition: its
  /// sides are at most 65535. Throws std::bad_alloc.
  BlockOrder(const PixelRect& rect, int tile, PixelOrder order);

  [[nodiscard]] std::size_t size() const { return places_.size(); }
  /// Block i < size(): precondition.
  [[nodiscard]] PixelRect operator[](std::size_t i) const;

  /// Bytes that the order of so many pixels takes.
  static std::uint64_t bytes(const PixelRect& rect, int tile);

 private:
  struct Place {
    std::uint16_t x, y;  ///< in blocks
  };

  PixelRect rect_;
  int tile_ = 1;
  std::vector<Place> places_;
};

/// A pixel's place in its block.
struct PixelOffset {
  std::uint16_t x, y;
};

/// All pixels of a `tile` x `tile` block along a Morton curve, x first: where `tile` is a multiple
/// of 4, four pixels in a row are 2 x 2 of the picture, eight 4 x 2, sixteen 4 x 4: one packet.
/// `tile` as for BlockOrder. Throws std::bad_alloc.
std::vector<PixelOffset> block_pixels(int tile);

}  // namespace boule
