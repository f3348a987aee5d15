#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/math/similarity.h"
#include "core/scene/group.h"
#include "simd/abi/geometry.h"

namespace boule {

/// A transformation in the form of the kernels, and the reverse.
inline PlacementView placement_of(const std::optional<Similarity>& transform) {
  const Similarity t = transform.value_or(Similarity{});
  return {t.row_x, t.row_y, t.row_z, t.scale, t.shift, transform.has_value()};
}
inline Similarity similarity_of(const PlacementView& p) {
  return {p.row_x, p.row_y, p.row_z, p.scale, p.shift};
}

/// The sphere in a slot of a part, as placed in the scene, with an arbitrary material.
inline Sphere sphere_of(const PartView& part, std::size_t slot) {
  const SphereBlock& block = part.blocks[slot / bvh_leaf_size];
  const std::size_t k = slot % bvh_leaf_size;
  const Sphere own{
      {block.center_x[k], block.center_y[k], block.center_z[k]}, block.radius[k], MaterialRef()};
  return part.placement.moves ? transformed(own, similarity_of(part.placement), std::nullopt) : own;
}

}  // namespace boule
