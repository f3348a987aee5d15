#pragma once

#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/scene/scene.h"
#include "simd/geometry/geometry.h"

namespace boule {

/// The geometry of a valid scene without instances; its spheres are taken.
inline Geometry build_geometry(Scene& scene, const std::vector<Plane>& planes,
                               const ParallelFor& parallel_for) {
  if (scene.packed)
    return {scene.packed->tree, static_cast<std::size_t>(scene.packed->count), planes};
  return {std::move(scene.spheres), planes, Structure::automatic, parallel_for};
}

}  // namespace boule
