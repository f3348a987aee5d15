#pragma once

#include <array>
#include <cstdint>

#include "render/files/particles/colors/color_map.h"

namespace boule {

/// Evenly spaced colours of a map, from its least to its largest number: 0xrrggbb.
using ColorMapSamples = std::array<std::uint32_t, 65>;

/// The samples of a map; those of matplotlib 3.6, rounded. Straight lines between them are at most
/// 1 code off its own colours (cividis: 2).
const ColorMapSamples& samples_of(NamedColorMap map);

}  // namespace boule
