#include "render/python/data.h"

#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/number_text.h"
#include "core/scene/scene.h"
#include "render/particles/elements.h"
#include "render/python/arrays.h"
#include "render/python/call.h"
#include "render/python/errors.h"
#include "render/python/values.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// A picture of H x W pixels with so many numbers each, of which the first three count.
Data picture_of(const py::object& argument, const std::string& name, int components) {
  const py::array array = to_array(argument, name);
  const bool is_picture = array.ndim() == 3 && array.shape(2) == components;
  const bool is_small = is_picture && array.shape(0) <= max_image_side &&
                        array.shape(1) <= max_image_side && array.size() > 0;
  if (!is_small) {
    throw_error(name, "expected float32 or float64 of shape (H, W, " + std::to_string(components) +
                          "), sides from 1 to " + std::to_string(max_image_side) + ", got " +
                          describe(array));
  }
  const auto rows = static_cast<std::size_t>(array.shape(0) * array.shape(1));
  const py::object flat = array.attr("reshape")(rows, components);
  const Numbers numbers(flat, name,
                        {.rows = rows, .columns = static_cast<std::size_t>(components)});
  auto image =
      std::make_shared<Image>(static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)));
  for (std::size_t i = 0; i < rows; ++i) {
    const auto at = [&](std::size_t k) { return static_cast<float>(numbers.at(i, k)); };
    image->pixels[i] = {at(0), at(1), components > 2 ? at(2) : 0};
  }
  return Data{std::shared_ptr<const Image>(image)};
}

/// A lens prescription: N surfaces of radius, thickness, index, aperture.
Data lens_of(const py::object& argument) {
  const Numbers numbers(argument, "surfaces", {.columns = 4});
  auto surfaces = std::make_shared<std::vector<LensSurface>>(numbers.rows());
  for (std::size_t i = 0; i < numbers.rows(); ++i) {
    const auto at = [&](std::size_t k) { return static_cast<float>(numbers.at(i, k)); };
    (*surfaces)[i] = {at(0), at(1), at(2), at(3)};
  }
  return Data{std::shared_ptr<const std::vector<LensSurface>>(surfaces)};
}

/// Numbers of each particle, finite.
std::vector<double> column_of(const py::object& argument, const std::string& name,
                              std::size_t rows) {
  const Numbers numbers(argument, name, {.rows = rows});
  std::vector<double> values(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    values[i] = numbers.at(i);
    if (std::isfinite(values[i])) continue;
    throw_error(name,
                "row " + std::to_string(i) + ": must be finite, is " + number_text(values[i]));
  }
  return values;
}

/// The symbol of an element by its atomic number, or the number as text.
std::string symbol_of(const py::handle& value, const std::string& name) {
  const auto elements = all_elements();
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(value.ptr(), &overflow);
  const bool is_element =
      overflow == 0 && number >= 1 && number <= static_cast<long long>(elements.size());
  if (!is_element) return to_text(py::str(value), name);
  return std::string(elements[static_cast<std::size_t>(number) - 1].symbol);
}

/// As many texts as there are particles, as something that can be gone through.
py::object sequence_of(const py::object& argument, const std::string& name, std::size_t rows) {
  const bool is_array = py::hasattr(argument, "tolist") && py::hasattr(argument, "shape");
  // First: what is too large is not copied.
  const bool fits = is_array ? py::make_tuple(rows).equal(argument.attr("shape"))
                             : py::isinstance<py::sequence>(argument) &&
                                   !py::isinstance<py::str>(argument) && py::len(argument) == rows;
  if (!fits) {
    throw_error(name, "expected " + std::to_string(rows) + " texts, one for each particle");
  }
  return is_array ? py::object(argument.attr("tolist")()) : argument;
}

/// Texts of each particle. Whole numbers are atomic numbers where they are species.
TextColumn texts_of(const py::object& argument, const std::string& name, std::size_t rows) {
  TextColumn column{name, {}, {}};
  std::map<std::string, std::uint32_t> known;
  const bool are_species = name == "species";
  for (const py::handle value : sequence_of(argument, name, rows)) {
    const bool is_number = are_species && py::isinstance<py::int_>(value);
    const std::string text = is_number ? symbol_of(value, name) : to_text(py::str(value), name);
    const auto [place, is_new] =
        known.emplace(text, static_cast<std::uint32_t>(column.texts.size()));
    if (is_new) column.texts.push_back(text);
    column.indices.push_back(place->second);
  }
  if (column.indices.size() != rows) throw_error(name, "has changed while it was read");
  return column;
}

/// True for numbers, which become a column of numbers.
bool holds_numbers(const py::object& argument) {
  if (!py::hasattr(argument, "dtype")) {
    if (!py::isinstance<py::sequence>(argument) || py::len(argument) == 0) return true;
    const py::object first = argument[py::int_(0)];
    return py::isinstance<py::float_>(first) || py::isinstance<py::int_>(first);
  }
  const auto kind = py::cast<std::string>(py::str(argument.attr("dtype").attr("kind")));
  return kind == "f" || kind == "i" || kind == "u";
}

ParticleCell cell_of(const py::object& cell, const std::vector<bool>& periodic) {
  const Numbers numbers(cell, "cell", {.rows = 3, .columns = 3});
  ParticleCell made;
  Vec3d* const edges[] = {&made.a, &made.b, &made.c};
  for (std::size_t i = 0; i < 3; ++i) {
    *edges[i] = {numbers.at(i, 0), numbers.at(i, 1), numbers.at(i, 2)};
    made.periodic[i] = periodic.size() == 3 && periodic[i];
  }
  if (!is_finite(made)) throw_error("cell", "must be finite");
  return made;
}

/// Particles in memory, as a file would hold them.
Data particles_of(const py::object& positions, const py::object& species, const py::dict& columns,
                  const py::object& cell, const std::vector<bool>& periodic, double angstrom) {
  const Numbers points(positions, "positions", {.columns = 3});
  ParticleFrame frame;
  frame.length_in_angstrom = angstrom;
  frame.positions.resize(points.rows());
  for (std::size_t i = 0; i < points.rows(); ++i) {
    frame.positions[i] = {points.at(i, 0), points.at(i, 1), points.at(i, 2)};
    const Vec3d& p = frame.positions[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw_error("positions", "row " + std::to_string(i) + ": must be finite");
  }
  if (!species.is_none()) frame.species = texts_of(species, "species", points.rows());
  for (const auto& [key, values] : columns) {
    const std::string name = to_text(py::str(key), "columns");
    const auto object = py::reinterpret_borrow<py::object>(values);
    if (holds_numbers(object)) {
      frame.numbers.push_back({name, column_of(object, name, points.rows())});
    } else {
      frame.texts.push_back(texts_of(object, name, points.rows()));
    }
  }
  if (!cell.is_none()) frame.cell = cell_of(cell, periodic);
  return Data{std::make_shared<ParticleFile>(ParticleFile::of(std::move(frame)))};
}

/// Spheres as they are held: views, where these have the numbers.
py::dict sphere_views(const py::object& data) {
  const auto* held =
      std::get_if<std::shared_ptr<const SphereArrays>>(&py::cast<const Data&>(data).held);
  if (held == nullptr) throw_error("spheres", "expected spheres");
  const SphereArrays& arrays = **held;
  const auto count = static_cast<py::ssize_t>(arrays.spheres.size());
  constexpr auto step = static_cast<py::ssize_t>(sizeof(Sphere));
  constexpr auto number = static_cast<py::ssize_t>(sizeof(float));
  const Sphere* const first = arrays.spheres.data();
  py::dict views;
  const float* const center = first == nullptr ? nullptr : &first->center.x;
  const float* const radius = first == nullptr ? nullptr : &first->radius;
  views["centers"] = arrays.centers.empty()
                         ? view_of<float>(center, {count, 3}, {step, number}, data)
                         : view_of<double>(&arrays.centers.front().x, {count, 3},
                                           {static_cast<py::ssize_t>(sizeof(Vec3d)),
                                            static_cast<py::ssize_t>(sizeof(double))},
                                           data);
  views["radii"] = view_of<float>(radius, {count}, {step}, data);
  views["base"] = py::make_tuple(arrays.base.x, arrays.base.y, arrays.base.z);
  return views;
}

/// The colours that spheres have of their own, N x 3 of uint8 (black where they have none), or
/// None.
py::object sphere_colors(const Data& data) {
  const auto* held = std::get_if<std::shared_ptr<const SphereArrays>>(&data.held);
  if (held == nullptr) throw_error("spheres", "expected spheres");
  if (!(*held)->has_colors) return py::none();
  const std::vector<Sphere>& spheres = (*held)->spheres;
  auto colors = empty_array<std::uint8_t>({static_cast<py::ssize_t>(spheres.size()), 3});
  std::uint8_t* next = colors.mutable_data();
  for (const Sphere& sphere : spheres) {
    const SrgbColor color = sphere.material.has_color() ? sphere.material.color() : SrgbColor{};
    for (const std::uint8_t code : {color.r, color.g, color.b}) *next++ = code;
  }
  return colors;
}

}  // namespace

void bind_data(py::module_& module) {
  module.def("picture", &picture_of, py::arg("pixels"), py::arg("name"), py::arg("components"));
  module.def("lens", &lens_of, py::arg("surfaces"));
  module.def("particles", &particles_of, py::arg("positions"), py::arg("species"),
             py::arg("columns"), py::arg("cell"), py::arg("periodic"), py::arg("angstrom"));
  module.def("sphere_views", &sphere_views, py::arg("data"));
  module.def("sphere_colors", &sphere_colors, py::arg("data"));
}

}  // namespace boule::python
