#include "render/apps/parts/part_blocks.h"

#include <algorithm>
#include <cstdint>

#include "render/frame/pixel_order.h"

namespace boule {
namespace {

std::string named(const PixelRect& r) {
  return "pixels " + std::to_string(r.x0) + "," + std::to_string(r.y0) + "," +
         std::to_string(r.x1) + "," + std::to_string(r.y1);
}

/// The rectangle of equal counts that begins at (x, y): to the right first, then down.
PixelRect grown(const PixelRect& rect, const std::vector<std::uint8_t>& times, int x, int y) {
  const std::uint8_t wanted = times[rect.index(x, y)];
  PixelRect found{x, y, x + 1, y + 1};
  while (found.x1 < rect.x1 && times[rect.index(found.x1, y)] == wanted) ++found.x1;
  const auto is_row = [&](int row) {
    for (int at = found.x0; at < found.x1; ++at) {
      if (times[rect.index(at, row)] != wanted) return false;
    }
    return true;
  };
  while (found.y1 < rect.y1 && is_row(found.y1)) ++found.y1;
  return found;
}

}  // namespace

int shared_tile(const PixelRect& rect, int shares, int blocks_each) {
  constexpr int smallest = 16, largest = 128;
  const std::uint64_t each = static_cast<std::uint64_t>(std::max(blocks_each, 1));
  int tile = largest;
  while (tile > smallest && rect.area() < each * static_cast<std::uint64_t>(shares) *
                                              static_cast<std::uint64_t>(tile) *
                                              static_cast<std::uint64_t>(tile))
    tile /= 2;
  return tile;
}

std::vector<PixelRect> blocks_of_shard(const PixelRect& rect, int tile, const Shard& shard) {
  const BlockOrder all(rect, tile, PixelOrder::tiles);
  std::vector<PixelRect> blocks;
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < all.size();
       i += static_cast<std::size_t>(shard.count))
    blocks.push_back(all[i]);
  return blocks;
}

std::string find_gap(const PixelRect& rect, const std::vector<PixelRect>& blocks) {
  std::vector<std::uint8_t> times(static_cast<std::size_t>(rect.area()));
  for (const PixelRect& block : blocks) {
    for (int y = block.y0; y < block.y1; ++y) {
      for (int x = block.x0; x < block.x1; ++x) {
        std::uint8_t& count = times[rect.index(x, y)];
        count = static_cast<std::uint8_t>(std::min(count + 1, 2));
      }
    }
  }
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      const std::uint8_t count = times[rect.index(x, y)];
      if (count == 1) continue;
      return named(grown(rect, times, x, y)) + (count == 0 ? " are missing" : " are there twice");
    }
  }
  return {};
}

}  // namespace boule
