#pragma once

#include <array>
#include <cstdint>

#include "core/math/random.h"

namespace boule::bench {

/// Four random numbers in [0, 1): draw number `draw` for an item, under a seed.
inline std::array<double, 4> random4(std::uint32_t item, std::uint32_t draw, std::uint32_t seed) {
  const auto words = philox({item, draw, 0, 0}, {seed, 0});
  return {unit_interval(words[0]), unit_interval(words[1]), unit_interval(words[2]),
          unit_interval(words[3])};
}

}  // namespace boule::bench
