#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/scenes/random4.h"
#include "core/scene/primitive.h"

namespace boule::bench {

/// The scene uN: n random spheres in the unit cube that cover a picture of it four times over.
inline std::vector<Sphere> uniform_spheres(std::size_t n) {
  const double radius = std::sqrt(4 / (3.141592653589793 * static_cast<double>(n)));
  std::vector<Sphere> spheres(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = random4(static_cast<std::uint32_t>(i), 0, 7);
    spheres[i].center = {static_cast<float>(at[0]), static_cast<float>(at[1]),
                         static_cast<float>(at[2])};
    spheres[i].radius = static_cast<float>(radius);
  }
  return spheres;
}

}  // namespace boule::bench
