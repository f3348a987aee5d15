#include <string>

#include "render/apps/job/look_choices.h"
#include "render/apps/python/job_arguments.h"
#include "render/apps/python/scenes.h"
#include "render/apps/python/values.h"

namespace py = pybind11;

namespace boule::python {

std::string text_of(const Arguments& given, const char* name, char between) {
  const py::object value = *given.find(name);
  if (py::isinstance<py::str>(value)) return *given.text(name);
  if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) return py::str(value);
  TreeBuilder builder;
  py::dict table;
  table[name] = value;
  const py::object plain = to_python(builder.members(table, "").front().value);
  if (!py::isinstance<py::tuple>(plain)) return py::str(plain);
  std::string text;
  for (const py::handle one : plain) {
    if (!text.empty()) text += between;
    text += std::string(py::str(one));
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
