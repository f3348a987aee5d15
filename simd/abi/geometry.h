#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/vec.h"
#include "simd/abi/bvh.h"
#include "simd/abi/capsules.h"

namespace boule {

/// Spheres in slots, in blocks of sixteen, in an order that suits the kernels. Kernels test the
/// first `scanned` slots without the tree. Those slots also exist as a structure of arrays, padded
/// to max_width. The leaves of the tree follow: leaf k is block scanned / 16 + k. Empty slots have
/// a negative id, and rays always miss them.
struct SphereView {
  const float* center_x;
  const float* center_y;
  const float* center_z;
  const float* radius;
  /// r2p of filter_bounds.h; inf where the reject must let the pair through.
  const float* reject_squared;
  /// The square root of reject_squared: r (1 + slack u) + floor, rounded outward; inf where the
  /// reject must let the pair through.
  const float* reject_radius;
  std::size_t scanned;        ///< number of slots outside the leaves; with a tree whole blocks
  const SphereBlock* blocks;  ///< block k holds the slots from 16 k on
  std::size_t block_count;
  const std::int32_t* id;  ///< id of the sphere in each slot
};

/// Infinite planes as a structure of arrays, padded to max_width; plane k has the id first_id + k.
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

/// The placement of a part's spheres: the point p of the part is at scale (R p) + shift in the
/// scene (core/math/similarity.h). The radius is multiplied by `scale`. Every number is computed in
/// double and rounded to float once, as transformed() in core/scene/group.h does it.
struct PlacementView {
  Vec3d row_x, row_y, row_z;  ///< the rows of the rotation R
  double scale;
  Vec3d shift;
  bool moves;  ///< false: the spheres keep the part's coordinates, bit for bit
};

/// A tree over spheres at some place in the scene. Several parts may share the tree. All spheres,
/// placed or not, are within the range of the filters.
struct PartView {
  PlacementView placement;
  const BvhNode* nodes;           ///< null: kernels test all spheres
  const SphereBlock* blocks;      ///< as in SphereView
  const std::int32_t* id;         ///< by slot; the id in the scene is first_id higher
  std::uint32_t scanned;          ///< number of slots outside the leaves, in whole blocks
  std::uint32_t scanned_spheres;  ///< number of spheres in those slots, which come first
  std::uint32_t slots;            ///< number of slots in all blocks
  std::uint32_t first_slot;       ///< the part's first slot in the scene
  std::int32_t first_id;
};

/// Spheres in several parts. Slots and ids count on from part to part. A tree over the boxes of the
/// parts replaces the tree over spheres: it is GeometryView::bvh, and its leaves, of size 1, are
/// parts.
struct PartsView {
  const PartView* parts;
  std::size_t size;  ///< 0: the spheres are in GeometryView::spheres
};

/// All primitives that rays can hit.
struct GeometryView {
  SphereView spheres;  ///< empty where there are parts
  PlaneView planes;
  BvhView bvh;
  PartsView parts;
  CapsuleView capsules;
};

}  // namespace boule
