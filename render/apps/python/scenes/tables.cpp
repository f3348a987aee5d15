#include "render/apps/python/scenes/tables.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/field_values.h"
#include "render/apps/python/values/presence.h"
#include "render/files/scene_file/toml/toml_camera.h"
#include "render/files/scene_file/toml/toml_camera_keys.h"
#include "render/files/scene_file/toml/toml_color_map.h"
#include "render/files/scene_file/toml/toml_entities.h"
#include "render/files/scene_file/toml/toml_fields.h"
#include "render/files/scene_file/toml/toml_particle_style.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// Materials and groups that are not looked up: only a scene knows which there are.
class AnyNames final : public TomlNames {
 public:
  std::uint32_t material_of(TomlTable& table) override { return any(table, "material"); }
  MaterialRef colored_material_of(TomlTable& table) override {
    if (table.has("color")) static_cast<void>(read_color_codes(table, "color"));
    return any(table, "material");
  }
  std::uint32_t group_of(TomlTable& table) override { return any(table, "group"); }

 private:
  static std::uint32_t any(TomlTable& table, const char* key) {
    std::string name;
    table.read(key, name);
    return 0;
  }
};

template <class T>
void read_object(TomlTable& table) {
  AnyNames names;
  T value;
  TomlFields(table, &names).read(value);
  if constexpr (std::is_same_v<T, Instance>) {
    table.finish({"group"});
  } else {
    table.finish();
  }
  table.check(find_problem(value));
}

/// The table of a kind, and what it may name besides files.
struct Tree {
  TomlMembers members;
  SceneData data;
};

/// The root of a scene file that has nothing but one table.
TomlMembers root_of(const std::string& kind, const TomlMembers& members) {
  return {{kind, {}, {{}, members}}};
}

/// A camera as it begins and, if it moves, as it is in the frame of each key.
void read_camera_table(const TomlMembers& members, FirstError& error) {
  TomlMembers root = root_of("camera", members);
  TomlTable given(members, {}, "camera", error);
  bool is_fitted = false;
  given.read("fit", is_fitted);
  std::optional<CameraMotion> motion;
  if (!is_fitted) motion = apply_camera_keys(root, std::nullopt, error);
  if (!error.status()) return;
  TomlTable table(std::get<TomlMembers>(root.front().value.data), {}, "camera", error);
  if (read_camera_fit(table)) return;
  const Camera camera = read_camera(table);
  if (motion && table.ok()) check_camera_keys(*motion, camera, table);
}

void read_distortion_table(const TomlMembers& members, FirstError& error) {
  const TomlMembers camera = root_of("distortion", members);
  TomlTable table(camera, {}, "", error);
  read_distortion(table);
}

void read_particle_table(TomlTable& table) {
  std::string text;
  int frame = 0;
  bool water = false;
  std::vector<std::string> columns;
  for (const char* key : {"file", "format", "material", "topology"}) table.read(key, text);
  table.read("frame", frame);
  table.read("water", water);
  table.read("columns", columns);
  read_particle_style(table);
  table.finish({"file"});
}

/// How the table of a kind is read.
void read_table(const std::string& kind, const TomlMembers& members, FirstError& error) {
  if (kind == "camera") return read_camera_table(members, error);
  if (kind == "distortion") return read_distortion_table(members, error);
  TomlTable table(members, {}, "", error);
  Scene scene;
  if (kind == "image") return table.check(find_problem(read_image_settings(table)));
  if (kind == "render") return table.check(find_problem(read_render(table)));
  if (kind == "background") return static_cast<void>(read_background(table, scene));
  if (kind == "material") return static_cast<void>(read_material(table));
  if (kind == "light") return static_cast<void>(read_light(table));
  if (kind == "clip") return static_cast<void>(read_clip(table));
  if (kind == "sphere") return read_object<Sphere>(table);
  if (kind == "plane") return read_object<Plane>(table);
  if (kind == "capsule") return read_object<Capsule>(table);
  if (kind == "instance") return read_object<Instance>(table);
  if (kind == "particles") return read_particle_table(table);
  if (kind == "map") {
    read_color_map(table);
    return table.finish();
  }
  table.report("kind", "there is no kind " + quote(kind));
}

/// Whether a field's value stands in a file.
template <class Rule>
constexpr bool is_in_file = std::is_same_v<Rule, FileRule>;

template <class T>
void list_keys(const py::dict& defaults, py::list& keys) {
  each_field<T>([&](const auto& field) {
    using Rule = std::remove_cvref_t<decltype(field.rule)>;
    const py::str key{std::string(field.key)};
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>,
                                 Field<T, CameraPose, TypeRule>>) {
      list_keys<CameraPose>(defaults, keys);
    } else {
      keys.append(py::make_tuple(
          key, defaults.contains(key) ? py::object(defaults[key]) : py::object(py::none()),
          is_in_file<Rule>));
    }
  });
}

template <class T>
void list_struct(py::dict& types) {
  py::list keys;
  list_keys<T>(FieldValues().of(T{}), keys);
  types[py::str(std::string(fields<T>.type))] = keys;
}

template <class... Kinds>
py::dict list_kinds(const std::variant<Kinds...>*) {
  py::dict types;
  (list_struct<Kinds>(types), ...);
  return types;
}

template <class T>
py::dict list_kinds(const T*) {
  py::dict types;
  list_struct<T>(types);
  return types;
}

template <class T>
py::dict kinds() {
  return list_kinds(static_cast<const T*>(nullptr));
}

/// The name under which a table's key "file" has an array; none if it has the name of a file.
std::optional<std::string> name_of_array(const Tree& tree) {
  for (const TomlMember& member : tree.members) {
    const auto* name = std::get_if<std::string>(&member.value.data);
    if (member.key != "file" || name == nullptr) continue;
    if (tree.data.pictures.contains(*name) || tree.data.lenses.contains(*name)) return *name;
  }
  return std::nullopt;
}

/// An error of the reader of scene files as one about an argument: without the path of the table,
/// and about the array, if one stands in place of the file.
Diagnostic as_argument(Diagnostic error, const std::string& kind, const std::string& array,
                       const Tree& tree) {
  if (error.key.starts_with(kind + ".")) error.key.erase(0, kind.size() + 1);
  if (error.key != "file" || array.empty()) return error;
  if (error.message == "missing key 'file'") error.message += ", or " + quote(array);
  const auto name = name_of_array(tree);
  if (!name) return error;
  error.key = array;
  const std::string prefix = quote(*name) + ": ";
  if (error.message.starts_with(prefix)) error.message.erase(0, prefix.size());
  return error;
}

}  // namespace

py::dict list_fields() {
  py::dict all;
  all["image"] = kinds<ImageSettings>();
  all["render"] = kinds<RenderSettings>();
  all["camera"] = kinds<Camera>();
  all["fit"] = kinds<CameraFit>();
  all["distortion"] = kinds<DistortionMap>();
  all["background"] = kinds<Background>();
  all["material"] = kinds<Material>();
  all["light"] = kinds<Light>();
  all["clip"] = kinds<Clip>();
  all["sphere"] = kinds<Sphere>();
  all["plane"] = kinds<Plane>();
  all["capsule"] = kinds<Capsule>();
  all["instance"] = kinds<Instance>();
  py::list scene;
  each_field<Scene>([&](const auto& field) {
    // Known by a file only.
    if (field.key == "packed" || field.key == "outline_groups") return;
    scene.append(std::string(field.key));
  });
  all["scene"] = scene;
  return all;
}

py::dict check_table(const std::string& kind, const py::dict& dictionary,
                     const std::string& array) {
  TreeBuilder builder;
  const auto tree = std::make_shared<Tree>();
  tree->members = builder.members(dictionary, "");
  tree->data = builder.data();
  const auto read = [tree, kind, array](Call&) -> Status {
    FirstError error("", std::nullopt, &tree->data);
    read_table(kind, tree->members, error);
    if (error.status()) return {};
    return as_argument(error.status().error(), kind, array, *tree);
  };
  // A picture or a lens in a file may take its time.
  const bool reads_file = kind != "particles" && dictionary.contains("file") &&
                          py::isinstance<py::str>(dictionary["file"]);
  Call here;
  check(reads_file ? interruptible(read) : read(here));
  return to_python(tree->members);
}

void bind_tables(py::module_& module) {
  module.def("fields", &list_fields, inside(),
             "The keys of each kind and type of table, with defaults.");
  module.def("check", &check_table, inside(), py::arg("kind"), py::arg("table"), py::arg("array"),
             "Raise Error if a table is wrong; return its values as plain ones.");
}

}  // namespace boule::python
