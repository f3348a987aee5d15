#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "core/base/parallel.h"
#include "render/apps/python/values/arrays.h"
#include "render/files/scene_file/loaded/scene_data.h"

namespace boule::python {

/// Centres and radii in arrays.
struct SphereInput {
  Numbers centers;  ///< N x 3
  Numbers radii;    ///< N, or one for all

  SphereInput(const pybind11::object& centers, const pybind11::object& radii);
};

/// The spheres, checked. Centres of double precision are kept as they are. Without the GIL.
Result<SphereArrays> make_spheres(const SphereInput& input, const ParallelFor& parallel_for);

/// The spheres alone, counted from the origin that is chosen for them: for rays.
struct PlacedSpheres {
  std::vector<Sphere> spheres;
  Vec3d origin{};
};
/// `origin` is none for "auto".
Result<PlacedSpheres> place_spheres(const SphereInput& input, const std::optional<Vec3d>& origin,
                                    const ParallelFor& parallel_for);

void bind_sphere_arrays(pybind11::module_& module);

}  // namespace boule::python
