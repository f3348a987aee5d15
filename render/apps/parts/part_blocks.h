#pragma once

#include <string>
#include <vector>

#include "render/frame/pixel_rect.h"

namespace boule {

/// Share `index` of `count` of a picture, 1 <= index <= count.
struct Shard {
  int index = 1, count = 1;
};

/// The side of the blocks in which a picture is shared out. It depends on the picture and on the
/// number of shares only, so that all machines agree: about `blocks_each` for a share, of 16 to 128
/// pixels a side.
int shared_tile(const PixelRect& rect, int shares, int blocks_each = 16);

/// Every shard.count-th of the blocks of side `tile` that cover `rect`, along a Morton curve.
std::vector<PixelRect> blocks_of_shard(const PixelRect& rect, int tile, const Shard& shard);

/// What is wrong with blocks that ought to cover `rect` once: "pixels X0,Y0,X1,Y1 are missing" or
/// "are there twice", the first such place in reading order; empty if nothing is. Precondition: the
/// blocks lie in `rect`.
std::string find_gap(const PixelRect& rect, const std::vector<PixelRect>& blocks);

}  // namespace boule
