#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/srgb.h"
#include "render/particles/color_map.h"

namespace boule {

/// What the colours of particles mean: one entry for each species, or a map of numbers.
struct ParticleColors {
  struct Species {
    std::string name{};
    SrgbColor color{};
    std::size_t count = 0;  ///< of particles that are shown, without periodic images
  };
  struct Scale {
    std::string by{};  ///< as MappedColors
    ColorMap map{};
    std::array<double, 2> range{};  ///< that was chosen
  };
  /// Those that are shown, in the order of the file; or the texts of another column that tells
  /// particles apart. Empty for other rules.
  std::vector<Species> species;
  std::optional<Scale> scale;
};

}  // namespace boule
