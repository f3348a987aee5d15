#include <string>

#include "render/cli/look_values.h"
#include "render/particle_file/particle_file.h"
#include "render/python/choices.h"
#include "render/python/errors.h"
#include "render/python/scenes.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// What is given for a key as the text that the command line has: "1,0,0", "#000000,#ffffff".
std::string text_of(const py::handle& value, const std::string& key) {
  TreeBuilder builder;
  py::dict table;
  table[py::str(key)] = value;
  const TomlMembers members = builder.members(table, "");
  std::string text;
  const auto add = [&](const py::handle& one) {
    text += (text.empty() ? "" : ",") + std::string(py::str(one));
  };
  const py::object plain = to_python(members.front().value);
  if (!py::isinstance<py::tuple>(plain)) return py::str(plain);
  for (const py::handle one : plain) add(one);
  return text;
}

/// The keys of a dictionary, one by one.
class LookKeys {
 public:
  LookKeys(const py::dict& keys, cli::LookOptions& look) : keys_(keys), look_(look) {}

  /// Parses the text of a key, if it is there.
  template <class Target, class Parse>
  void read(const char* key, Target& target, const Parse& parse, const char* expected) {
    const auto value = find(key);
    if (!value) return;
    const std::string text = text_of(*value, key);
    const auto parsed = parse(text);
    if (!parsed) throw_error(key, quote(text) + " is not understood, expected " + expected);
    target = *parsed;
  }
  void read(const char* key, bool& target) {
    const auto value = find(key);
    if (!value) return;
    if (!py::isinstance<py::bool_>(*value)) throw_error(key, "expected True or False");
    target = py::cast<bool>(*value);
    if (target) note(key);
  }

 private:
  std::optional<py::object> find(const char* key) {
    if (!keys_.contains(key) || keys_[key].is_none()) return std::nullopt;
    py::object value = keys_[key];
    if (!py::isinstance<py::bool_>(value)) note(key);
    return value;
  }
  void note(const char* key) {
    if (look_.first.empty()) look_.first = std::string("--") + key;
  }

  const py::dict& keys_;
  cli::LookOptions& look_;
};

}  // namespace

cli::LookOptions look_of(const py::dict& keys) {
  using namespace cli;
  LookOptions look;
  LookKeys all(keys, look);
  std::string name;
  all.read("look", name, parse_words, "the name of a look");
  if (!name.empty()) look.look = choose<Look>(name, "look");
  all.read("quick", look.quick);
  if (look.quick && !name.empty()) throw_error("quick", "cannot stand beside 'look'");
  all.read("floor", look.floor);
  all.read("input_format", look.format, parse_words, "the name of a format");
  all.read("columns", look.columns, parse_names, "names such as id,type,x,y,z");
  all.read("water", look.water);
  all.read("color", look.color, parse_particle_color, "element, #rrggbb or a column");
  all.read("map", look.map, parse_map, "the name of a map, or colours #rrggbb");
  all.read("range", look.range, parse_range, "two numbers, the first below the second");
  all.read("radius", look.radius, parse_radius, "a number above 0, vdw, covalent or a column");
  all.read("scale", look.scale, parse_above_0, "a number above 0");
  all.read("select", look.select, parse_words, "such as \"type == 1 && x > 0\"");
  const char* const directions = "x, -x, y, -y, z, -z or three numbers";
  all.read("view", look.view, parse_direction, directions);
  all.read("up", look.up, parse_direction, directions);
  if (!look.map.empty() && !may_have_color_map(look.color))
    throw_error("map", "needs 'color' to be a column");
  if (look.range && !may_have_color_map(look.color))
    throw_error("range", "needs 'color' to be a column");
  return look;
}

}  // namespace boule::python
