#include <string>

#include "render/apps/job/options/look_choices.h"
#include "render/apps/python/scenes/scenes.h"
#include "render/apps/python/values/job_arguments.h"

namespace py = pybind11;

namespace boule::python {

namespace {

/// A number as its shortest text, whatever type of Python it has; else the object's own text.
std::string text_of_one(const py::handle& value, const char* name) {
  const auto number = [&]() -> py::object {
    if (py::isinstance<py::str>(value)) return {};
    if (PyObject* const whole = PyNumber_Index(value.ptr()); whole != nullptr)
      return py::reinterpret_steal<py::object>(whole);
    PyErr_Clear();
    if (PyObject* const real = PyNumber_Float(value.ptr()); real != nullptr)
      return py::reinterpret_steal<py::object>(real);
    PyErr_Clear();
    return {};
  }();
  try {
    return py::str(number ? number : py::reinterpret_borrow<py::object>(value));
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw_error(name, "is too large a number");
  }
}

bool is_list(const py::object& value) {
  return PySequence_Check(value.ptr()) != 0 && !py::isinstance<py::str>(value) &&
         !py::isinstance<py::bytes>(value) &&
         !(py::hasattr(value, "shape") && py::len(value.attr("shape")) == 0);
}

}  // namespace

std::string text_of(const Arguments& given, const char* name, char between) {
  const py::object value = *given.find(name);
  if (py::isinstance<py::str>(value)) return *given.text(name);
  std::string text;
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [key, one] : py::reinterpret_borrow<py::dict>(value)) {
      if (!text.empty()) text += between;
      text += text_of_one(key, name) + "=" + text_of_one(one, name);
    }
    return text;
  }
  if (!is_list(value)) return text_of_one(value, name);
  for (const py::handle one : value) {
    if (!text.empty()) text += between;
    text += text_of_one(one, name);
  }
  return text;
}

LookOptions look_of(const py::dict& keys) {
  const Arguments given(keys);
  LookOptions look;
  look.first = read_rows(given, look_choices(), look);
  if (look.quick && given.find("look")) throw_error("quick", "cannot stand beside 'look'");
  if (!look.map.empty() && !may_have_color_map(look.color))
    throw_error("map", "needs 'color' to be a column");
  if (look.range && !may_have_color_map(look.color))
    throw_error("range", "needs 'color' to be a column");
  return look;
}

}  // namespace boule::python
