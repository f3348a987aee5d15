#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/vec.h"
#include "simd/abi/bvh.h"

namespace boule {

/// Spheres in slots, in blocks of sixteen, in an order that suits the kernels. The first `scanned`
/// slots are scanned and are also there as a structure of arrays, padded to max_width. The leaves
/// of the tree follow: leaf k is block scanned / 16 + k. No ray hits a slot that holds no sphere;
/// such slots have a negative id.
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

/// Where the spheres of a part are: at p -> scale (R p) + shift of where the part has them
/// (core/math/similarity.h). The radius is scaled. Every number is computed in double and rounded
/// to float once, as transformed() of core/scene/group.h does it.
struct PlacementView {
  Vec3d row_x, row_y, row_z;  ///< of R
  double scale;
  Vec3d shift;
  bool moves;  ///< false: the spheres are where the part has them, bit for bit
};

/// A tree over spheres, somewhere in the scene. Parts may share the tree. All spheres, moved or
/// not, are within the range of the filters.
struct PartView {
  PlacementView placement;
  const BvhNode* nodes;           ///< null: all spheres are scanned
  const SphereBlock* blocks;      ///< as in SphereView
  const std::int32_t* id;         ///< in the part, by its slots; in the scene more by first_id
  std::uint32_t scanned;          ///< slots in no leaf, whole blocks
  std::uint32_t scanned_spheres;  ///< of these, those in front that hold a sphere
  std::uint32_t slots;            ///< of all blocks
  std::uint32_t first_slot;       ///< a slot in the scene is more than one in the part by this
  std::int32_t first_id;
};

/// Spheres in several parts. Slots and ids count on from part to part. A tree of their boxes leads
/// to them: BvhView, whose leaves, of size 1, are parts, in place of a tree over spheres.
struct PartsView {
  const PartView* parts;
  std::size_t size;  ///< 0: the spheres are those of GeometryView::spheres
};

/// All that rays can meet.
struct GeometryView {
  SphereView spheres;  ///< none where there are parts
  PlaneView planes;
  BvhView bvh;
  PartsView parts;
};

}  // namespace boule
