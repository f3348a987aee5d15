#include "render/apps/python/values/arrays.h"

#include <cstdlib>
#include <utility>

#include "render/apps/python/values/call.h"
#include "render/apps/python/values/errors.h"

namespace py = pybind11;

namespace boule::python {
namespace {

constexpr std::size_t most_rows = 2147483647;

std::string shape_text(const Numbers::Shape& shape) {
  const std::string rows = shape.rows ? std::to_string(*shape.rows) : "N";
  std::string many = shape.columns == 1 ? "(" + rows + ",)"
                                        : "(" + rows + ", " + std::to_string(shape.columns) + ")";
  if (!shape.takes_one) return many;
  return many +
         (shape.columns == 1 ? " or one number" : " or (" + std::to_string(shape.columns) + ",)");
}

[[noreturn]] void refuse(const std::string& name, const Numbers::Shape& shape,
                         const std::string& got) {
  const std::string types = shape.takes_bytes ? "float32, float64 or uint8" : "float32 or float64";
  throw_error(name, "expected " + types + " of shape " + shape_text(shape) + ", got " + got);
}

/// True for numbers in memory as the machine has them, of a type that is read in place.
bool is_readable(const py::array& array, bool takes_bytes) {
  const py::dtype type = array.dtype();
  const char order = type.byteorder();
  const bool is_native = order == '=' || order == '|' || order == '<';
  const bool is_float = type.kind() == 'f' && (type.itemsize() == 4 || type.itemsize() == 8);
  return is_native && (is_float || (takes_bytes && type.kind() == 'u' && type.itemsize() == 1));
}

/// Floats of whatever numbers these are; others are refused.
py::array to_floats(const py::array& array, const std::string& name, const Numbers::Shape& shape) {
  if (is_readable(array, shape.takes_bytes)) return array;
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') refuse(name, shape, describe(array));
  return py::array::ensure(array.attr("astype")("float64"));
}

}  // namespace

py::module_ need_numpy() {
  py::module_ numpy = py::module_::import("numpy");
  static bool is_known = false;  // the GIL guards it
  if (is_known) return numpy;
  const auto version = numpy.attr("__version__").cast<std::string>();
  if (std::atoi(version.c_str()) >= numpy_below)
    throw py::import_error("numpy is " + version + ", but this boule was built for numpy<" +
                           std::to_string(numpy_below));
  is_known = true;
  return numpy;
}

bool is_masked(const py::object& argument) {
  return py::hasattr(argument, "mask") && py::hasattr(argument, "filled");
}

void refuse_masked(const py::object& argument, const std::string& name) {
  if (!is_masked(argument)) return;
  const auto masked = need_numpy().attr("count_nonzero")(argument.attr("mask")).cast<long>();
  if (masked == 0) return;
  throw_error(name, "is a masked array, and " + std::to_string(masked) +
                        " of its values are masked: leave them out (compressed()) or fill them "
                        "(filled())");
}

py::array to_array(const py::object& argument, const std::string& name) {
  refuse_masked(argument, name);
  try {
    return py::array::ensure(need_numpy().attr("asarray")(argument));
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_MemoryError) || error.matches(PyExc_KeyboardInterrupt)) throw;
    throw_error(name, "numpy makes no array of it: " + std::string(py::str(error.value())));
  }
}

std::string describe(const py::array& array) {
  return std::string(py::str(array.dtype())) + " of shape " +
         std::string(py::str(array.attr("shape")));
}

Numbers::Numbers(const py::object& argument, const std::string& name, const Shape& shape) {
  if (py::isinstance<py::str>(argument) || py::isinstance<py::bytes>(argument) ||
      py::isinstance<py::dict>(argument) || argument.is_none()) {
    refuse(name, shape, type_name(argument));
  }
  const py::array given = to_array(argument, name);
  point_to(given, name, shape);  // first: what is too large is not converted
  const py::array numbers = to_floats(given, name, shape);
  if (!numbers.is(given)) point_to(numbers, name, shape);
  is_bytes_ = numbers.dtype().kind() == 'u';
  column_.is_double = numbers.dtype().itemsize() == 8;
  owner_ = keep(numbers);
}

/// Finds out what the dimensions mean.
void Numbers::point_to(const py::array& array, const std::string& name, const Shape& shape) {
  const auto dimensions = static_cast<std::size_t>(array.ndim());
  const auto side = [&](std::size_t i) {
    return static_cast<std::size_t>(array.shape(static_cast<py::ssize_t>(i)));
  };
  const auto step = [&](std::size_t i) {
    return static_cast<std::ptrdiff_t>(array.strides(static_cast<py::ssize_t>(i)));
  };
  column_ = {};
  column_.first = static_cast<const unsigned char*>(array.data());
  const bool has_rows = dimensions == 2 && side(1) == shape.columns;
  const bool is_list = dimensions == 1 && shape.columns == 1;
  is_one_ = shape.takes_one &&
            (shape.columns == 1 ? dimensions == 0 : dimensions == 1 && side(0) == shape.columns);
  if (is_one_) {
    rows_ = shape.rows.value_or(1);
    if (dimensions == 1) column_.component_step = step(0);
    return;
  }
  if (!has_rows && !is_list) refuse(name, shape, describe(array));
  rows_ = side(0);
  column_.ray_step = step(0);
  if (has_rows) column_.component_step = step(1);
  if (shape.rows && rows_ != *shape.rows) refuse(name, shape, describe(array));
  if (rows_ > most_rows) throw_error(name, "has more than " + std::to_string(most_rows) + " rows");
}

}  // namespace boule::python
