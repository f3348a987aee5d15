#pragma once

#include <cstdint>
#include <vector>

#include "render/image/image.h"

namespace boule {

/// A picture in 8-bit sRGB (IEC 61966-2-1), interleaved RGB, row 0 on top: 3 bytes for each of
/// image.pixels. With alpha it is RGBA with straight colours, 4 bytes for each: a colour is divided
/// by its alpha, and uncovered pixels are 0. Alpha has no curve. Colours are multiplied by 2^stops,
/// clamped to 0..1, and rounded to the nearest code of the exact curve; NaN and negative numbers
/// become 0. `stops` is clamped to -126..126, and NaN counts as 0. Same bytes on every machine.
std::vector<std::uint8_t> tone_map(const Image& image, float stops);

}  // namespace boule
