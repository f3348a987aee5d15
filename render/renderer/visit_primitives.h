#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/chunks.h"
#include "core/base/parallel.h"
#include "render/prepare/prepared_scene.h"
#include "simd/geometry/bvh_builder.h"
#include "simd/geometry/geometry.h"
#include "simd/geometry/part_placement.h"

namespace boule {

/// Calls visit(sphere) for each sphere as it is placed in the scene, and visit(capsule) for each
/// capsule, in parallel.
template <class Visit>
void visit_primitives(const Geometry& geometry, const ParallelFor& parallel_for,
                      const Visit& visit) {
  const GeometryView view = geometry.view();
  const auto visit_part = [&](const PartView& part, std::size_t slots) {
    in_chunks(parallel_for, slots, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t slot = begin; slot < end; ++slot) {
        if (part.id[slot] >= 0) visit(sphere_of(part, slot));
      }
    });
  };
  PartView whole{};
  whole.blocks = view.spheres.blocks;
  whole.id = view.spheres.id;
  visit_part(whole, view.spheres.block_count * bvh_leaf_size);
  for (std::size_t i = 0; i < view.parts.size; ++i)
    visit_part(view.parts.parts[i], view.parts.parts[i].slots);
  const CapsuleView& capsules = view.capsules;
  in_chunks(parallel_for, capsules.slots, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      if (capsules.id[slot] != empty_slot)
        visit(geometry.capsule(static_cast<std::uint32_t>(slot)));
    }
  });
}

/// The same of a prepared scene, ghosts included.
template <class Visit>
void visit_primitives(const PreparedScene& scene, const ParallelFor& parallel_for,
                      const Visit& visit) {
  visit_primitives(scene.geometry, parallel_for, visit);
  if (scene.ghosts) visit_primitives(scene.ghosts->scene->geometry, parallel_for, visit);
}

}  // namespace boule
