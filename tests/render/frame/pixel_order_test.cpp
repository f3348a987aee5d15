#include "render/frame/pixel_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace boule {
namespace {

constexpr PixelOrder all_orders[] = {PixelOrder::rows, PixelOrder::tiles, PixelOrder::progressive,
                                     PixelOrder::frameless};

/// How often each pixel of the rectangle is visited, block by block.
std::vector<int> visits(const PixelRect& rect, int tile, PixelOrder order) {
  std::vector<int> count(static_cast<std::size_t>(rect.area()));
  const BlockOrder blocks(rect, tile, order);
  const std::vector<PixelOffset> pixels = block_pixels(tile);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const PixelRect block = blocks[i];
    EXPECT_TRUE(contains(rect, block) && !block.empty());
    for (const PixelOffset& offset : pixels) {
      const int x = block.x0 + offset.x, y = block.y0 + offset.y;
      if (x >= block.x1 || y >= block.y1) continue;
      ++count[static_cast<std::size_t>((y - rect.y0) * rect.width() + x - rect.x0)];
    }
  }
  return count;
}

TEST(PixelOrder, VisitsEveryPixelOnce) {
  const PixelRect rects[] = {{0, 0, 1, 1},   {0, 0, 16, 16}, {0, 0, 37, 23},  {0, 0, 1, 100},
                             {0, 0, 100, 1}, {5, 7, 38, 60}, {13, 0, 14, 65}, {100, 200, 165, 263}};
  for (const PixelRect& rect : rects) {
    for (const int tile : {1, 2, 3, 5, 8, 16, 17, 64}) {
      for (const PixelOrder order : all_orders) {
        const std::vector<int> count = visits(rect, tile, order);
        EXPECT_EQ(std::count(count.begin(), count.end(), 1), static_cast<long>(count.size()))
            << rect.x1 << "x" << rect.y1 << " tile " << tile << " order "
            << static_cast<int>(order);
      }
    }
  }
}

TEST(PixelOrder, PacketsCoverCompactRectangles) {
  const std::vector<PixelOffset> pixels = block_pixels(16);
  struct Packet {
    std::size_t size;
    int width, height;
  };
  for (const auto& [size, width, height] : {Packet{4, 2, 2}, Packet{8, 4, 2}, Packet{16, 4, 4}}) {
    for (std::size_t first = 0; first < pixels.size(); first += size) {
      const PixelOffset corner = pixels[first];
      std::set<std::pair<int, int>> seen;
      for (std::size_t k = first; k < first + size; ++k) {
        const int x = pixels[k].x - corner.x, y = pixels[k].y - corner.y;
        EXPECT_TRUE(x >= 0 && x < width && y >= 0 && y < height);
        seen.insert({x, y});
      }
      EXPECT_EQ(seen.size(), size);
    }
  }
  EXPECT_EQ(pixels[1].x, 1);  // x comes first
  EXPECT_EQ(pixels[1].y, 0);
}

std::vector<std::pair<int, int>> corners(const BlockOrder& blocks) {
  std::vector<std::pair<int, int>> places;
  for (std::size_t i = 0; i < blocks.size(); ++i) places.emplace_back(blocks[i].x0, blocks[i].y0);
  return places;
}

TEST(PixelOrder, EachOrderIsWhatItsNameSays) {
  using Places = std::vector<std::pair<int, int>>;
  const PixelRect rect{0, 0, 4, 4};
  const Places rows = corners(BlockOrder(rect, 1, PixelOrder::rows));
  EXPECT_EQ(Places(rows.begin(), rows.begin() + 5),
            (Places{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 1}}));
  const Places tiles = corners(BlockOrder(rect, 1, PixelOrder::tiles));
  EXPECT_EQ(Places(tiles.begin(), tiles.begin() + 6),
            (Places{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {3, 0}}));
  const Places progressive = corners(BlockOrder(rect, 1, PixelOrder::progressive));
  EXPECT_EQ(Places(progressive.begin(), progressive.begin() + 4),
            (Places{{0, 0}, {2, 0}, {0, 2}, {2, 2}}));
  const Places frameless = corners(BlockOrder(rect, 1, PixelOrder::frameless));
  EXPECT_NE(frameless, rows);
  EXPECT_NE(frameless, tiles);
  EXPECT_EQ(frameless, corners(BlockOrder(rect, 1, PixelOrder::frameless)));
}

TEST(PixelOrder, CountsItsMemory) {
  EXPECT_EQ(BlockOrder::bytes({0, 0, 65535, 65535}, 16), 4096u * 4096u * 4u);
  EXPECT_EQ(BlockOrder::bytes({3, 3, 4, 4}, 16), 4u);
}

TEST(PixelOrder, AnEmptyRectangleHasNoBlocks) {
  EXPECT_EQ(BlockOrder({5, 5, 5, 9}, 4, PixelOrder::tiles).size(), 0u);
  EXPECT_EQ(PixelRect({5, 5, 4, 9}).area(), 0u);
}

}  // namespace
}  // namespace boule
