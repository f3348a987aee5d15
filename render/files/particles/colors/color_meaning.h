#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/srgb.h"
#include "render/files/particles/colors/color_map.h"

namespace boule {

/// The meaning of the particles' colours: one entry for each species, or a map of numbers.
struct ParticleColors {
  struct Species {
    std::string name{};
    SrgbColor color{};
    std::size_t count = 0;  ///< number of shown particles, without periodic images
  };
  struct Scale {
    std::string by{};  ///< as MappedColors
    ColorMap map{};
    std::array<double, 2> range{};  ///< the chosen range
    SrgbColor nan_color = missing_color;
    std::size_t missing = 0;  ///< particles without a number, of that colour
    /// Whether some numbers lie below and above the range; of a series, whether they may.
    bool goes_below = false, goes_above = false;
    std::string unit{};  ///< of its numbers; empty: unknown
  };
  /// The shown species, in the order of the file; or the texts of another column that distinguishes
  /// particles. Empty for other rules.
  std::vector<Species> species;
  std::optional<Scale> scale;
};

}  // namespace boule
