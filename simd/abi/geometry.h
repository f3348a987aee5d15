#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/bvh.h"

namespace boule {

/// Spheres in slots, in blocks of sixteen, in an order that suits the kernels. The first `scanned`
/// slots are tested against every ray and are also there as a structure of arrays, padded to
/// max_width. The leaves of the tree follow: leaf k is block scanned / 16 + k. No ray hits a slot
/// that holds no sphere; such slots have a negative id.
struct SphereView {
  const float* center_x;
  const float* center_y;
  const float* center_z;
  const float* radius;
  /// r2p of filter_bounds.h; inf where the reject must not decide.
  const float* reject_squared;
  /// Its root, r (1 + slack u) + floor, rounded outward; inf where the reject must not decide.
  const float* reject_radius;
  std::size_t scanned;        ///< slots that are in no leaf; with a tree whole blocks
  const SphereBlock* blocks;  ///< block k: the slots from 16 k on
  std::size_t block_count;
  const std::int32_t* id;  ///< of the sphere in each slot
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
  BvhView bvh;
};

}  // namespace boule
