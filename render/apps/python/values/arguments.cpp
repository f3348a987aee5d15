#include "render/apps/python/values/arguments.h"

#include <limits>

#include "core/scene/number_text.h"
#include "render/apps/python/values/errors.h"
#include "simd/dispatch/dispatch.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// Which numbers may come, with the end that describe() leaves out: a number of Python may be
/// beyond.
std::string describe_all(const WholeRule& rule) {
  constexpr int most = std::numeric_limits<int>::max();
  return describe(rule) + (rule.high == most ? " and at most " + std::to_string(most) : "");
}

}  // namespace

std::optional<py::object> Arguments::find(const char* name) const {
  if (!given_.contains(name) || given_[name].is_none()) return std::nullopt;
  return py::object(given_[name]);
}

std::optional<int> Arguments::whole(const char* name, const WholeRule& rule) const {
  const auto object = find(name);
  if (!object) return std::nullopt;
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(object->ptr()));
  if (!index) {
    PyErr_Clear();
    throw_error(name, "expected a whole number, got " + type_name(*object));
  }
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  const bool fits = overflow == 0 && number >= rule.low && number <= rule.high;
  if (!fits)
    throw_error(name, "must be " + describe_all(rule) + ", is " +
                          std::string(py::str(index)).substr(0, 40));
  return static_cast<int>(number);
}

std::optional<double> Arguments::number(const char* name, const NumberRule& rule) const {
  const auto object = find(name);
  if (!object) return std::nullopt;
  const double number = PyFloat_AsDouble(object->ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw_error(name, "expected a number, got " + type_name(*object));
  }
  if (!rule.allows(number))
    throw_error(name, "must be " + describe(rule) + ", is " + number_text(number));
  return number;
}

std::optional<std::string> Arguments::text(const char* name) const {
  const auto object = find(name);
  if (!object) return std::nullopt;
  if (!py::isinstance<py::str>(*object))
    throw_error(name, "expected text, got " + type_name(*object));
  py::ssize_t size = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(object->ptr(), &size);
  if (bytes != nullptr) return std::string(bytes, static_cast<std::size_t>(size));
  PyErr_Clear();
  throw_error(name, "is text that is not UTF-8");
}

bool Arguments::flag(const char* name) const {
  const auto object = find(name);
  if (!object) return false;
  if (!py::isinstance<py::bool_>(*object)) throw_error(name, "expected True or False");
  return py::cast<bool>(*object);
}

std::optional<std::string> isa_of(const Arguments& given) {
  auto name = given.text("isa");
  if (!name || *name == "auto") return name;
  const auto kernels = select_kernels(*name);
  if (!kernels) throw_error("isa", kernels.error().message);
  return name;
}

}  // namespace boule::python
