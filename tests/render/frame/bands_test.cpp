#include "render/frame/bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace boule::test {
namespace {

struct Case {
  PixelRect rect;
  int tile;
  unsigned workers;
};

const Case cases[] = {{{0, 0, 1, 1}, 16, 1},        {{0, 0, 640, 480}, 128, 2},
                      {{7, 3, 1006, 778}, 64, 5},   {{0, 0, 33, 4000}, 16, 64},
                      {{5, 0, 4101, 2048}, 256, 2}, {{0, 60'000, 16'000, 60'250}, 1024, 3}};

TEST(Bands, EveryPixelIsInOneBlock) {
  for (const Case& c : cases) {
    const Bands bands(c.rect, c.tile, c.workers, 12);
    const auto width = static_cast<std::size_t>(c.rect.width());
    std::vector<int> times(c.rect.area(), 0);
    std::size_t of_band = 0;
    for (std::size_t block = 0; block < bands.blocks(); ++block) {
      const PixelRect rect = bands.block(block);
      const std::size_t band = bands.band_of(block);
      ASSERT_TRUE(contains(bands[band], rect)) << block;
      of_band = block > 0 && band == bands.band_of(block - 1) ? of_band + 1 : 1;
      const bool is_last = block + 1 == bands.blocks() || bands.band_of(block + 1) != band;
      if (is_last) {
        EXPECT_EQ(of_band, bands.blocks_in(band));
      }
      for (int y = rect.y0; y < rect.y1; ++y) {
        const auto row = static_cast<std::size_t>(y - c.rect.y0) * width;
        for (int x = rect.x0; x < rect.x1; ++x)
          ++times[row + static_cast<std::size_t>(x - c.rect.x0)];
      }
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(times.size()));
  }
}

TEST(Bands, FollowEachOtherFromTheTop) {
  for (const Case& c : cases) {
    const Bands bands(c.rect, c.tile, c.workers, 12);
    int next = c.rect.y0;
    for (std::size_t band = 0; band < bands.size(); ++band) {
      EXPECT_EQ(bands[band].y0, next);
      EXPECT_EQ(bands[band].x0, c.rect.x0);
      EXPECT_EQ(bands[band].x1, c.rect.x1);
      next = bands[band].y1;
    }
    EXPECT_EQ(next, c.rect.y1);
  }
}

/// Whatever the picture's size, unless two rows are too much.
TEST(Bands, TakeLittleMemory) {
  for (const int side : {1, 500, 4096, 16'384, 65'535}) {
    for (const unsigned workers : {1U, 2U, 64U}) {
      const Bands bands({0, 0, side, side}, 128, workers, 17);
      EXPECT_LE(bands.in_memory() * bands[0].area() * 17, Bands::most_bytes) << side;
      if (side > 1) {
        EXPECT_GE(bands.in_memory(), std::min<std::size_t>(2, bands.size()));
      }
    }
  }
}

}  // namespace
}  // namespace boule::test
