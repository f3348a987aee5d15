#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/scene.h"
#include "render/scene_file/toml_fields.h"
#include "render/scene_file/toml_table.h"

namespace boule {

/// The tables of the objects of a scene or a group, in the order of the file.
struct ObjectTables {
  /// A [[sphere]], or a [[spheres]], which names a file of them.
  struct Spheres {
    TomlTable table;
    bool is_bulk;
  };
  std::vector<Spheres> spheres;
  std::vector<TomlTable> planes;
  std::vector<TomlTable> instances;
};

/// Takes them from the table of a scene or a group; their keys become known.
ObjectTables object_tables(TomlTable& table);

/// Reads materials, and the objects of a scene and its groups: first read_materials(), then
/// start_groups(), then the others.
class TomlObjects final : private TomlNames {
 public:
  /// Scene and error must outlive it.
  TomlObjects(Scene& scene, FirstError& error) : scene_(scene), error_(error) {}

  void read_materials(std::vector<TomlTable> tables);

  /// Gives every group its number: instances may name groups that come later.
  void start_groups(const std::vector<TomlTable>& tables);
  void read_group(std::size_t group, TomlTable& table);
  void read_scene(ObjectTables& tables);

  /// Reports what find_instance_problem() finds at the instance's table, and an error if there is
  /// no memory for the spheres and planes that the instances show.
  void check_instances();

 private:
  /// Where an instance was read.
  struct InstanceTable {
    std::optional<std::size_t> group;  ///< as in InstanceProblem
    std::size_t instance;
    TomlTable table;
  };

  void read_spheres(std::vector<ObjectTables::Spheres>& tables, std::vector<Sphere>& spheres);
  void read_sphere(TomlTable& table, std::vector<Sphere>& spheres);
  void read_bulk(TomlTable& table, std::vector<Sphere>& spheres);
  void read_plane(TomlTable& table, std::vector<Plane>& planes);
  void read_instances(std::vector<TomlTable>& tables, std::optional<std::size_t> group,
                      std::vector<Instance>& instances);
  /// Reads a struct that may refer to materials and groups, with these keys required.
  template <class T>
  T read_checked(TomlTable& table, std::initializer_list<std::string_view> required = {});
  std::uint32_t group_of(TomlTable& table) override;
  std::uint32_t material_of(TomlTable& table) override;
  std::uint32_t default_material();

  Scene& scene_;
  FirstError& error_;
  std::map<std::string, std::uint32_t> material_ids_;
  std::map<std::string, std::uint32_t> group_ids_;
  std::optional<std::uint32_t> default_id_;
  std::vector<InstanceTable> instance_tables_;
};

}  // namespace boule
