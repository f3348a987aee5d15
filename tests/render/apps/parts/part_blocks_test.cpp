// How a picture is shared out in blocks, and what is told of blocks that do not make one.
#include "render/apps/parts/part_blocks.h"

#include <gtest/gtest.h>

namespace boule::test {
namespace {

constexpr PixelRect frame{0, 0, 100, 70};

std::vector<PixelRect> all_shards(const PixelRect& rect, int tile, int count) {
  std::vector<PixelRect> all;
  for (int k = 1; k <= count; ++k) {
    const auto some = blocks_of_shard(rect, tile, {k, count});
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

TEST(PartBlocks, ShardsTogetherCoverEveryPixelOnce) {
  for (const PixelRect& rect : {frame, PixelRect{17, 3, 64, 64}, PixelRect{5, 5, 6, 6}}) {
    for (const int tile : {16, 32, 128}) {
      for (const int count : {1, 2, 3, 7, 1000}) {
        EXPECT_EQ(find_gap(rect, all_shards(rect, tile, count)), "") << tile << " " << count;
      }
    }
  }
}

TEST(PartBlocks, FirstGapIsNamedAsARectangle) {
  EXPECT_EQ(find_gap(frame, {}), "pixels 0,0,100,70 are missing");
  EXPECT_EQ(find_gap(frame, {{0, 0, 100, 20}, {0, 20, 30, 70}, {60, 20, 100, 70}}),
            "pixels 30,20,60,70 are missing");
  EXPECT_EQ(find_gap(frame, {frame, {10, 20, 11, 22}}), "pixels 10,20,11,22 are there twice");
  EXPECT_EQ(find_gap(frame, {frame, frame, frame}), "pixels 0,0,100,70 are there twice");
}

TEST(PartBlocks, TilesDependOnPictureAndSharesOnly) {
  EXPECT_EQ(shared_tile({0, 0, 1920, 1080}, 4), 128);
  EXPECT_EQ(shared_tile({0, 0, 1920, 1080}, 64), 32);
  EXPECT_EQ(shared_tile({0, 0, 64, 64}, 1), 16);
  EXPECT_EQ(shared_tile({0, 0, 1920, 1080}, 4, 256), 32);
}

}  // namespace
}  // namespace boule::test
