#pragma once

#include <string>
#include <vector>

#include "core/math/srgb.h"
#include "render/files/particles/colors/color_meaning.h"

namespace boule {

/// Colours that are easily told apart, with defective colour vision too (M. Okabe and K. Ito, Color
/// Universal Design, 2008; grey instead of black). They repeat after `palette_size`.
inline constexpr std::size_t palette_size = 8;
SrgbColor palette_color(std::size_t index);

/// Kinds that have their colour already.
using KnownKinds = std::vector<ParticleColors::Species>;

/// A colour of the palette for each of these texts: those of `known` keep theirs, the others have
/// the first ones that are free, in their order, or by number if all of them are whole numbers, as
/// types are.
std::vector<SrgbColor> palette_colors(const std::vector<std::string>& texts,
                                      const KnownKinds& known = {});

/// A colour for each species: elements have those of Jmol, the others those of palette_colors().
std::vector<SrgbColor> species_colors(const std::vector<std::string>& species,
                                      const KnownKinds& known = {});

}  // namespace boule
