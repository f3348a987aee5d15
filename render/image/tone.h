#pragma once

#include <cstdint>
#include <vector>

#include "render/image/image.h"

namespace boule {

/// The 8-bit sRGB code (IEC 61966-2-1) of a linear value: clamped to 0..1, the exact curve, rounded
/// to nearest. NaN and everything below 0 is 0, infinity is 255. Same code on every machine.
std::uint8_t srgb_code(float linear);

/// The linear value, 0..1, that a value of the sRGB curve stands for, 0..1: the exact curve, which
/// goes on beyond; NaN for NaN. Same bits on every machine.
double linear_from_srgb(double s);

/// A picture as 8-bit sRGB: colours times 2^stops (stops clamped to -126..126, NaN counts as 0),
/// then srgb_code. Interleaved RGB, row 0 on top: 3 bytes for each of image.pixels, however many
/// there are. Throws std::bad_alloc.
std::vector<std::uint8_t> tone_map(const Image& image, float stops);

}  // namespace boule
