#pragma once

#include <string>
#include <vector>

#include "core/math/srgb.h"

namespace boule {

/// Colours that are easily told apart, with defective colour vision too (M. Okabe and K. Ito, Color
/// Universal Design, 2008; grey instead of black). They repeat after `palette_size`.
inline constexpr std::size_t palette_size = 8;
SrgbColor palette_color(std::size_t index);

/// A colour for each species: elements have those of Jmol, the others those of the palette in their
/// order.
std::vector<SrgbColor> species_colors(const std::vector<std::string>& species);

/// A colour of the palette for each of so many texts, in their order.
std::vector<SrgbColor> palette_colors(std::size_t count);

}  // namespace boule
