#pragma once

#include <cstddef>

namespace boule::bench {

/// What the half-b contenders read: spheres and rays as structures of arrays of float, padded to 16
/// and aligned to 64 bytes. Directions of unit length.
struct HalfBData {
  const float *center_x, *center_y, *center_z, *radius_squared;
  std::size_t spheres;
  const float *org_x, *org_y, *org_z, *dir_x, *dir_y, *dir_z;
  std::size_t rays;
  float* t;  ///< out: nearest t > 0, or infinity
};

using HalfB = void (*)(const HalfBData&);

}  // namespace boule::bench
