#include "render/apps/python/sphere_arrays.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include "core/math/geometry.h"
#include "core/scene/number_text.h"
#include "render/apps/python/call.h"
#include "render/apps/python/choices.h"
#include "render/apps/python/errors.h"
#include "render/apps/python/presence.h"
#include "render/apps/python/values.h"
#include "render/files/file/float32.h"
#include "render/files/particles/percentiles.h"
#include "render/files/scene_file/npy/npy_colors.h"
#include "render/files/scene_file/toml/toml_color_map.h"
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

Vec3d center_at(const Numbers& centers, std::size_t row) {
  return {centers.at(row, 0), centers.at(row, 1), centers.at(row, 2)};
}

Vec3f to_float(const Vec3d& v) {
  return {float32_or_inf(v.x), float32_or_inf(v.y), float32_or_inf(v.z)};
}

/// Where they are, before they are rounded.
SphereExtent extent_of(const SphereInput& input, const ParallelFor& parallel_for) {
  return boule::extent_of(input.centers.rows(), parallel_for,
                          [&](std::size_t i, SphereExtent& extent) {
                            extent.add(center_at(input.centers, i), input.radii.at(i));
                          });
}

/// Why a row is no sphere.
Diagnostic explain(const SphereInput& input, std::size_t row, const Vec3d& origin) {
  const Vec3d center = center_at(input.centers, row) - origin;
  const double radius = input.radii.at(row);
  const auto about = [&](const char* argument, const std::string& message) {
    return Diagnostic::about(argument, "row " + std::to_string(row) + ": " + message);
  };
  for (const double x : {center.x, center.y, center.z}) {
    if (!std::isfinite(x)) return about("centers", "must be finite, is " + number_text(x));
    if (!to_float32(x)) return about("centers", "is too large for a 32-bit float");
  }
  if (!std::isfinite(radius)) return about("radii", "must be finite, is " + number_text(radius));
  if (!to_float32(radius)) return about("radii", "is too large for a 32-bit float");
  if (radius > 0) return about("radii", "is too small for a 32-bit float: " + number_text(radius));
  return about("radii", "must be above 0, is " + number_text(radius));
}

/// Rounds all rows; the first bad one is the error.
Status round_all(const SphereInput& input, const Vec3d& origin, std::vector<Sphere>& spheres,
                 const ParallelFor& parallel_for) {
  spheres.resize(input.centers.rows());
  std::atomic<bool> all_valid{true};
  each_chunk(spheres.size(), parallel_for, [&](std::size_t begin, std::size_t end) {
    bool valid = true;
    for (std::size_t i = begin; i < end; ++i) {
      spheres[i] = {to_float(center_at(input.centers, i) - origin),
                    float32_or_inf(input.radii.at(i)), MaterialRef()};
      valid &= is_valid(spheres[i]);
    }
    if (!valid) all_valid = false;
  });
  if (all_valid) return {};
  const auto bad = std::find_if(spheres.begin(), spheres.end(),
                                [](const Sphere& sphere) { return !is_valid(sphere); });
  return explain(input, static_cast<std::size_t>(bad - spheres.begin()), origin);
}

Status check_room(const SphereInput& input) {
  const std::uint64_t count = input.centers.rows();
  const std::uint64_t exact = input.centers.is_double() ? count * sizeof(Vec3d) : 0;
  return check_memory(bytes_of_spheres(count) + exact, std::to_string(count) + " spheres need");
}

Status color_spheres(const Numbers& colors, ColorSpace space, SphereArrays& arrays) {
  if (colors.is_bytes() && space == ColorSpace::linear) {
    return Diagnostic::about("colors",
                             "are uint8, which are sRGB codes: linear colours must be floats");
  }
  for (std::size_t i = 0; i < arrays.spheres.size(); ++i) {
    std::array<std::uint8_t, 3> codes{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double component = colors.at(i, k);
      const auto code = color_code(colors.is_bytes() ? component / 255 : component, space);
      if (!code) {
        return Diagnostic::about(
            "colors",
            "row " + std::to_string(i) + ": must be from 0 to 1, is " + number_text(component));
      }
      codes[k] = *code;
    }
    arrays.spheres[i].material = MaterialRef::colored(0, {codes[0], codes[1], codes[2]});
  }
  arrays.has_colors = true;
  return {};
}

/// Colours by a map of one number for each; the range that was chosen.
Result<std::array<double, 2>> map_spheres(const Numbers& scalar, const ColorMapKeys& keys,
                                          SphereArrays& arrays, const ParallelFor& parallel_for) {
  std::vector<double> numbers(scalar.rows());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = scalar.at(i);
    if (std::isfinite(numbers[i])) continue;
    return Diagnostic::about(
        "scalar", "row " + std::to_string(i) + ": must be finite, is " + number_text(numbers[i]));
  }
  std::array<double, 2> range{0, 1};
  if (keys.range) range = *keys.range;
  if (!keys.range && !numbers.empty()) {
    range = percentiles(ParticleNumbers(numbers.data(), 1), numbers.size(), parallel_for);
  }
  const RangePlace place(range);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    arrays.spheres[i].material = MaterialRef::colored(0, keys.map.color(place(numbers[i])));
  }
  arrays.has_colors = true;
  return range;
}

ColorMapKeys read_map(const py::object& map, const py::object& range) {
  py::dict keys;
  keys["map"] = map;
  keys["range"] = range;
  TreeBuilder builder;
  const TomlMembers members = builder.members(keys, "");
  FirstError error("");
  TomlTable table(members, {}, "", error);
  ColorMapKeys read = read_color_map(table);
  check(error.status());
  return read;
}

void refuse_together(const py::object& colors, const py::object& scalar, const py::object& map,
                     const py::object& range) {
  if (!colors.is_none() && !scalar.is_none()) throw_error("scalar", "cannot stand beside 'colors'");
  if (scalar.is_none() && !(map.is_none() && range.is_none())) {
    throw_error(map.is_none() ? "range" : "map", "goes with 'scalar', which is missing");
  }
}

/// Spheres and their colours for a scene, and the range of their colour map, or None.
py::tuple spheres_of(const py::object& centers, const py::object& radii, const py::object& colors,
                     const std::string& color_space, const py::object& scalar,
                     const py::object& map, const py::object& range) {
  refuse_together(colors, scalar, map, range);
  const SphereInput input(centers, radii);
  const std::size_t count = input.centers.rows();
  std::optional<Numbers> rgb, numbers;
  if (!colors.is_none()) {
    rgb.emplace(colors, "colors", Numbers::Shape{.rows = count, .columns = 3, .takes_bytes = true});
  }
  if (!scalar.is_none()) numbers.emplace(scalar, "scalar", Numbers::Shape{.rows = count});
  const auto space = choose<ColorSpace>(color_space, "color_space");
  const ColorMapKeys keys = read_map(map, range);
  struct Made {
    std::shared_ptr<SphereArrays> arrays;
    std::optional<std::array<double, 2>> range;
  };
  auto made = take(interruptible([=](Call& call) -> Result<Made> {
    const ParallelFor parallel_for = call.parallel_for();
    auto arrays = make_spheres(input, parallel_for);
    if (!arrays) return arrays.error();
    Made all{std::make_shared<SphereArrays>(std::move(arrays).value()), {}};
    if (rgb) {
      if (auto done = color_spheres(*rgb, space, *all.arrays); !done) return done.error();
    }
    if (numbers) {
      auto chosen = map_spheres(*numbers, keys, *all.arrays, parallel_for);
      if (!chosen) return chosen.error();
      all.range = chosen.value();
    }
    return all;
  }));
  return py::make_tuple(Data{std::shared_ptr<const SphereArrays>(made.arrays)}, made.range);
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
    for (std::size_t i = begin; i < end; ++i) arrays.centers[i] = center_at(input.centers, i);
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
