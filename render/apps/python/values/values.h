#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/field.h"
#include "render/files/scene_file/loaded/scene_data.h"
#include "render/files/scene_file/toml/toml_document.h"

namespace boule::python {

/// Something large that a scene has in memory where a TOML file names a file.
struct Data {
  std::variant<std::shared_ptr<const SphereArrays>, std::shared_ptr<ParticleFile>,
               std::shared_ptr<const Image>, std::shared_ptr<const std::vector<LensSurface>>,
               std::shared_ptr<const CapsuleArrays>>
      held;
};

/// Makes a TOML tree of dictionaries, lists and numbers of Python, so that the reader of scene
/// files reads them: names, defaults, rules and errors are the same. What is None is left out. Data
/// get names and are collected. Under the key None stands a list of pairs (key, table): tables of
/// several keys in one order, as ids count them.
class TreeBuilder {
 public:
  /// Throws Error for what TOML has no value for; `path` is that of the table ("camera", "").
  TomlMembers members(const pybind11::dict& table, const std::string& path);

  [[nodiscard]] const SceneData& data() const { return data_; }

 private:
  TomlValue value(const pybind11::handle& object, const std::string& path);
  void add_in_order(const pybind11::handle& pairs, const std::string& path, TomlMembers& members);
  TomlArray elements(const pybind11::handle& sequence, const std::string& path);
  TomlValue of_array(const pybind11::handle& array, const std::string& path);
  std::string add(const Data& data);
  TextPlace next_place() { return {++line_, 1}; }

  SceneData data_;
  int line_ = 0;
  int depth_ = 0;
};

/// Text as UTF-8; an Error about `path` if it cannot be.
std::string to_text(const pybind11::handle& object, const std::string& path);

/// A value of a tree for Python: arrays become tuples, tables dictionaries.
pybind11::object to_python(const TomlValue& value);
pybind11::dict to_python(const TomlMembers& members);

/// Numbers as Python shows them best: the double with the fewest digits that rounds to the float.
pybind11::object to_python(float number);
pybind11::object to_python(const Vec3f& v);
pybind11::object to_python(const Color& c);

}  // namespace boule::python
