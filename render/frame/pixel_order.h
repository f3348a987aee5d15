#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/scene/names.h"
#include "render/frame/pixel_rect.h"

namespace boule {

/// The order in which the blocks of a picture are rendered (lecture "Frame loop"). The finished
/// picture is the same for all.
/// - rows: row by row.
/// - tiles: along a Morton curve.
/// - progressive: every 2^k-th block of every 2^k-th row, then those between, down to k = 0.
/// - frameless: shuffled.
enum class PixelOrder { rows, tiles, progressive, frameless };
template <>
inline constexpr std::array<std::string_view, 4> names<PixelOrder>{"rows", "tiles", "progressive",
                                                                   "frameless"};

inline constexpr int max_tile = 1024;  ///< pixels

/// The square blocks of a rectangle, in order. Every pixel is in exactly one block.
class BlockOrder {
 public:
  BlockOrder() = default;

  /// Blocks of `tile` x `tile` pixels, cut off at the right and lower edge of `rect`. A tile below
  /// 1 counts as 1, one above max_tile as max_tile. Precondition: the sides of `rect` are at most
  /// 65535.
  BlockOrder(const PixelRect& rect, int tile, PixelOrder order);

  [[nodiscard]] std::size_t size() const { return blocks_.size(); }
  /// Block i. Precondition: i < size().
  [[nodiscard]] PixelRect operator[](std::size_t i) const;

  /// The number of bytes of the order of such blocks.
  static std::uint64_t bytes(const PixelRect& rect, int tile);

 private:
  struct Block {
    std::uint16_t x, y;  ///< counted in blocks
  };

  PixelRect rect_;
  int tile_ = 1;
  std::vector<Block> blocks_;
};

/// A pixel, counted from the upper left one of its block.
struct PixelOffset {
  std::uint16_t x, y;
};

/// All pixels of a `tile` x `tile` block along a Morton curve, x first; `tile` as for BlockOrder.
/// If `tile` is a multiple of 4, each packet holds neighbours: four pixels in a row are 2 x 2 of
/// the picture, eight are 4 x 2, sixteen are 4 x 4.
std::vector<PixelOffset> block_pixels(int tile);

}  // namespace boule
