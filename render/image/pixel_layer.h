#pragma once

#include <cstdint>
#include <vector>

namespace boule {

/// A picture of 8 bits that is drawn over a tone-mapped one of the same size: R, G, B, A a pixel,
/// colours not premultiplied, row 0 on top.
struct PixelLayer {
  int width = 0, height = 0;
  std::vector<std::uint8_t> codes{};
};

/// Draws rows of the layer over those of a picture (tone_map()), of 3 or 4 codes a pixel, whose
/// first row is row `first` of the layer. Whole numbers only, so the same everywhere. Precondition:
/// the layer has these rows.
void draw_over(const PixelLayer& layer, int first, int channels, std::vector<std::uint8_t>& codes);

}  // namespace boule
