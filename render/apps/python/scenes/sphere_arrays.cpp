#include "render/apps/python/scenes/sphere_arrays.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "core/math/geometry.h"
#include "render/apps/python/scenes/array_rows.h"
#include "render/apps/python/values/array_colors.h"
#include "render/apps/python/values/presence.h"
#include "render/memory/available_memory.h"
#include "render/memory/scene_memory.h"

namespace py = pybind11;

namespace boule::python {
namespace {

constexpr std::size_t rows_of_chunk = std::size_t{1} << 15;

/// Calls body(begin, end) for all rows, chunk by chunk.
template <class Body>
void each_chunk(std::size_t rows, const ParallelFor& parallel_for, const Body& body) {
  parallel_for((rows + rows_of_chunk - 1) / rows_of_chunk, [&](std::size_t chunk) {
    body(chunk * rows_of_chunk, std::min(rows, (chunk + 1) * rows_of_chunk));
  });
}

/// Where they are, before they are rounded.
SphereExtent extent_of(const SphereInput& input, const ParallelFor& parallel_for) {
  return boule::extent_of(input.centers.rows(), parallel_for,
                          [&](std::size_t i, SphereExtent& extent) {
                            extent.add(point_at(input.centers, i), input.radii.at(i));
                          });
}

/// Rounds all rows; the first bad one is the error.
Status round_all(const SphereInput& input, const Vec3d& origin, std::vector<Sphere>& spheres,
                 const ParallelFor& parallel_for) {
  spheres.resize(input.centers.rows());
  std::atomic<bool> all_valid{true};
  each_chunk(spheres.size(), parallel_for, [&](std::size_t begin, std::size_t end) {
    bool valid = true;
    for (std::size_t i = begin; i < end; ++i) {
      spheres[i] = {rounded(point_at(input.centers, i) - origin), float32_or_inf(input.radii.at(i)),
                    MaterialRef()};
      valid &= is_valid(spheres[i]);
    }
    if (!valid) all_valid = false;
  });
  if (all_valid) return {};
  const auto bad = std::find_if(spheres.begin(), spheres.end(),
                                [](const Sphere& sphere) { return !is_valid(sphere); });
  const auto row = static_cast<std::size_t>(bad - spheres.begin());
  return explain_row(row, {{"centers", point_at(input.centers, row) - origin}}, "radii",
                     input.radii.at(row));
}

Status check_room(const SphereInput& input) {
  const std::uint64_t count = input.centers.rows();
  const std::uint64_t exact = input.centers.is_double() ? count * sizeof(Vec3d) : 0;
  return check_memory(bytes_of_spheres(count) + exact, std::to_string(count) + " spheres need");
}

/// Spheres and their colours for a scene, and the range of their colour map, or None.
py::tuple spheres_of(const py::object& centers, const py::object& radii, const py::object& colors,
                     const std::string& color_space, const py::object& scalar,
                     const py::object& map, const py::object& range) {
  ArrayColors::refuse_together(colors, scalar, map, range);
  const SphereInput input(centers, radii);
  const ArrayColors own(colors, color_space, scalar, map, range, input.centers.rows());
  return of_arrays<SphereArrays>(
      own, [input](const ParallelFor& parallel_for) { return make_spheres(input, parallel_for); });
}

}  // namespace

SphereInput::SphereInput(const py::object& centers_given, const py::object& radii_given)
    : centers(centers_given, "centers", {.columns = 3}),
      radii(radii_given, "radii", {.rows = centers.rows(), .takes_one = true}) {}

Result<SphereArrays> make_spheres(const SphereInput& input, const ParallelFor& parallel_for) {
  if (auto done = check_room(input); !done) return done.error();
  SphereArrays arrays;
  if (auto done = round_all(input, {}, arrays.spheres, parallel_for); !done) return done.error();
  if (!input.centers.is_double()) return arrays;
  arrays.centers.resize(input.centers.rows());
  each_chunk(arrays.centers.size(), parallel_for, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) arrays.centers[i] = point_at(input.centers, i);
  });
  return arrays;
}

Result<PlacedSpheres> place_spheres(const SphereInput& input, const std::optional<Vec3d>& origin,
                                    const ParallelFor& parallel_for) {
  if (auto done = check_room(input); !done) return done.error();
  PlacedSpheres placed;
  placed.origin = origin ? *origin : choose_origin({extent_of(input, parallel_for)});
  if (auto done = round_all(input, placed.origin, placed.spheres, parallel_for); !done)
    return done.error();
  return placed;
}

void bind_sphere_arrays(py::module_& module) {
  module.def("spheres", &spheres_of, inside(), py::arg("centers"), py::arg("radii"),
             py::arg("colors"), py::arg("color_space"), py::arg("scalar"), py::arg("map"),
             py::arg("range"));
}

}  // namespace boule::python
