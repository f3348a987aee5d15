#include "render/apps/python/values/errors.h"

#include <algorithm>
#include <string>

namespace py = pybind11;

namespace boule::python {
namespace {

constexpr const char* error_description =
    "What is wrong with a scene, a file or an argument.\n\n"
    "str() of it is one line. Attributes, each None where it is not known:\n"
    "  file    name of the file that it was read from\n"
    "  line    from 1\n"
    "  column  from 1\n"
    "  key     dotted path of the key or the name of the argument: 'camera.fov'";

/// Lives as long as the process: exceptions may be raised while the module is torn down.
py::handle error_type;

/// Without the dashes of an option.
std::string argument_name(std::string key) {
  if (!key.starts_with("--")) return key;
  key.erase(0, 2);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

/// Text that may hold any bytes of a file.
py::str to_str(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
}

py::object or_none(const std::string& text) {
  return text.empty() ? py::object(py::none()) : py::object(to_str(text));
}

py::object or_none(int number) {
  return number == 0 ? py::object(py::none()) : py::object(py::int_(number));
}

}  // namespace

void bind_errors(py::module_& module) {
  py::dict members;
  for (const char* name : {"file", "line", "column", "key"}) members[name] = py::none();
  members["__module__"] = "boule";
  error_type =
      PyErr_NewExceptionWithDoc("boule.Error", error_description, PyExc_ValueError, members.ptr());
  if (!error_type) throw py::error_already_set();
  module.attr("Error") = error_type;
}

void throw_error(const Diagnostic& error) {
  Diagnostic shown = error;
  shown.key = argument_name(shown.key);
  // Text that nobody wrote has no lines.
  if (shown.file.empty()) shown.line = shown.column = 0;
  std::string text = format_diagnostic(shown);
  if (text.starts_with("error: ")) text.erase(0, 7);
  if (error.of_memory) {
    PyErr_SetObject(PyExc_MemoryError, to_str(text).ptr());
    throw py::error_already_set();
  }
  const py::object exception = error_type(to_str(text));
  exception.attr("file") = or_none(shown.file);
  exception.attr("line") = or_none(shown.line);
  exception.attr("column") = or_none(shown.column);
  exception.attr("key") = or_none(shown.key);
  PyErr_SetObject(error_type.ptr(), exception.ptr());
  throw py::error_already_set();
}

void throw_error(const std::string& key, const std::string& message) {
  throw_error(Diagnostic::about(key, message));
}

std::string type_name(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

}  // namespace boule::python
