#pragma once

#include <cstddef>
#include <cstdint>

namespace boule {

/// Spheres as a structure of arrays, padded to max_width with spheres that nothing hits. The id of
/// a sphere is its place.
struct SphereView {
  const float* center_x;
  const float* center_y;
  const float* center_z;
  const float* radius;
  /// r2p of filter_bounds.h; inf where the reject must not decide.
  const float* reject_squared;
  /// Its root, r (1 + slack u) + floor, rounded outward; inf where the reject must not decide.
  const float* reject_radius;
  std::size_t size;
};

/// Infinite planes as a structure of arrays, padded likewise; plane k has the id first_id + k.
struct PlaneView {
  const float* point_x;
  const float* point_y;
  const float* point_z;
  const float* normal_x;
  const float* normal_y;
  const float* normal_z;
  std::size_t size;
  std::int32_t first_id;
};

/// All that rays can meet.
struct GeometryView {
  SphereView spheres;
  PlaneView planes;
};

}  // namespace boule
