#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/scene/number_text.h"
#include "render/apps/python/values/arguments.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/presence.h"
#include "render/apps/python/values/values.h"
#include "render/files/particle_file/frame/element_guess.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// "row 3: ...", as errors about one particle begin.
std::string of_row(std::size_t row, const std::string& message) {
  return "row " + std::to_string(row) + ": " + message;
}

/// Numbers of each particle, finite or missing: NaN, and what an array of numpy.ma masks.
std::vector<double> column_of(const py::object& argument, const std::string& name,
                              std::size_t rows) {
  const Numbers numbers(is_masked(argument)
                            ? argument.attr("astype")("float64").attr("filled")(std::nan(""))
                            : argument,
                        name, {.rows = rows});
  std::vector<double> values(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    values[i] = numbers.at(i);
    if (std::isfinite(values[i]) || std::isnan(values[i])) continue;
    throw_error(name, of_row(i, "must be finite, is " + number_text(values[i])));
  }
  return values;
}

/// The atomic number that a number of Python is, if it is one: whole, from 0 (ASE's X) to 118.
std::optional<std::size_t> atomic_number(const py::object& value) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) PyErr_Clear();  // it is too large: -1 came
  if (!(number >= 0 && number <= last_element) || number != std::floor(number)) return {};
  return static_cast<std::size_t>(number);
}

bool is_number(const py::object& value) {
  return !py::isinstance<py::bool_>(value) &&
         (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value));
}

/// What came in place of what was expected: a number, or the type of something else.
std::string came(const py::object& value) {
  if (is_number(value)) return std::string(py::str(value)).substr(0, 40);
  return type_name(value);
}

/// A number or a text of numpy as Python has it; all others as they are.
py::object plain(const py::handle& value) {
  const bool is_known = py::isinstance<py::str>(value) || py::isinstance<py::int_>(value) ||
                        py::isinstance<py::float_>(value) || py::isinstance<py::bytes>(value);
  if (is_known || !py::hasattr(value, "tolist")) return py::reinterpret_borrow<py::object>(value);
  return value.attr("tolist")();
}

/// A text, which HDF5 and others have as bytes; none if it is something else.
std::optional<std::string> text_of(const py::object& value, const std::string& name) {
  if (py::isinstance<py::str>(value)) return to_text(value, name);
  if (!py::isinstance<py::bytes>(value)) return std::nullopt;
  std::string_view bytes = py::cast<std::string_view>(value);
  const auto decoded = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "strict"));
  if (!decoded) {
    PyErr_Clear();
    throw_error(name, "has bytes that are not UTF-8");
  }
  return std::string(bytes);
}

/// What one particle is: a symbol, or an element by its atomic number.
std::string species_of(const py::object& value, const std::string& name, std::size_t row) {
  if (auto text = text_of(value, name)) return *text;
  if (is_number(value)) {
    if (const auto number = atomic_number(value)) return std::string(element_of_number(*number));
  }
  throw_error(name, of_row(row, "expected a symbol or an atomic number from 0 to " +
                                    std::to_string(last_element) + ", got " + came(value)));
}

/// A text of one particle in a column; numbers between texts, and flags, are taken as texts.
std::string cell_text(const py::object& value, const std::string& name, std::size_t row) {
  if (auto text = text_of(value, name)) return *text;
  if (py::isinstance<py::bool_>(value) || is_number(value)) return to_text(py::str(value), name);
  throw_error(name, of_row(row, "expected a text, got " + came(value)));
}

/// As many texts as there are particles, as something that can be gone through.
py::object sequence_of(const py::object& argument, const std::string& name, std::size_t rows) {
  refuse_masked(argument, name);
  const bool is_array = py::hasattr(argument, "tolist") && py::hasattr(argument, "shape");
  // First: what is too large is not copied.
  const bool is_text = py::isinstance<py::str>(argument) || py::isinstance<py::bytes>(argument);
  const bool fits =
      is_array ? py::make_tuple(rows).equal(argument.attr("shape"))
               : py::isinstance<py::sequence>(argument) && !is_text && py::len(argument) == rows;
  if (!fits) {
    throw_error(name, "expected " + std::to_string(rows) + " texts, one for each particle");
  }
  return is_array ? py::object(argument.attr("tolist")()) : argument;
}

/// Texts of each particle, by `read`, which is given a value and its row.
template <class Read>
TextColumn texts_of(const py::object& argument, const std::string& name, std::size_t rows,
                    const Read& read) {
  TextColumn column{name, {}, {}};
  std::map<std::string, std::uint32_t> known;
  for (const py::handle value : sequence_of(argument, name, rows)) {
    const std::string text = read(plain(value), name, column.indices.size());
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
    if (py::hasattr(first, "dtype")) return holds_numbers(first);
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

double length_of(const py::object& angstrom) {
  py::dict given;
  given["angstrom"] = angstrom;
  return Arguments(given).number("angstrom", rule::positive).value_or(1);
}

/// Particles in memory, as a file would hold them.
Data particles_of(const py::object& positions, const py::object& species, const py::dict& columns,
                  const py::object& cell, const std::vector<bool>& periodic,
                  const py::object& angstrom) {
  const Numbers points(positions, "positions", {.columns = 3});
  ParticleFrame frame;
  frame.length_in_angstrom = length_of(angstrom);
  frame.positions.resize(points.rows());
  for (std::size_t i = 0; i < points.rows(); ++i) {
    frame.positions[i] = {points.at(i, 0), points.at(i, 1), points.at(i, 2)};
    const Vec3d& p = frame.positions[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    throw_error("positions", of_row(i, "must be finite"));
  }
  if (!species.is_none()) frame.species = texts_of(species, "species", points.rows(), species_of);
  for (const auto& [key, values] : columns) {
    const std::string name = to_text(py::str(key), "columns");
    const auto object = py::reinterpret_borrow<py::object>(values);
    if (holds_numbers(object)) {
      frame.numbers.push_back({name, column_of(object, name, points.rows())});
    } else {
      frame.texts.push_back(texts_of(object, name, points.rows(), cell_text));
    }
  }
  if (!cell.is_none()) frame.cell = cell_of(cell, periodic);
  frame.axes_matter = frame.cell.has_value();
  return Data{std::make_shared<ParticleFile>(ParticleFile::of(std::move(frame)))};
}

}  // namespace

void bind_particle_arrays(py::module_& module) {
  module.def("particles", &particles_of, inside(), py::arg("positions"), py::arg("species"),
             py::arg("columns"), py::arg("cell"), py::arg("periodic"), py::arg("angstrom"));
}

}  // namespace boule::python
