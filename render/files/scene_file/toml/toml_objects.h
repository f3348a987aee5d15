#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/kinds.h"
#include "core/scene/scene.h"
#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/files/scene_file/loaded/particle_facts.h"
#include "render/files/scene_file/loaded/scene_data.h"
#include "render/files/scene_file/toml/toml_fields.h"
#include "render/files/scene_file/toml/toml_particles.h"
#include "render/files/scene_file/toml/toml_sphere_colors.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// The tables of the objects of a scene or a group, in the order of the file.
struct ObjectTables {
  /// What spheres come from: a [[sphere]], or a file that [[spheres]] or [[particles]] name.
  enum class Source { sphere, spheres, particles };
  struct Spheres {
    TomlTable table;
    Source source;
    std::optional<TomlParticles> particles{};  ///< once they are read
  };
  std::vector<Spheres> spheres;
  std::vector<TomlTable> planes;
  struct Capsules {
    TomlTable table;
    bool are_many;  ///< [[capsules]]
  };
  std::vector<Capsules> capsules;
  std::vector<TomlTable> instances;
};

/// Takes them from the table of a scene or a group; their keys become known.
ObjectTables object_tables(TomlTable& table);

/// The spheres or capsules in memory that a table [[spheres]] or [[capsules]] names, or null.
template <class Primitive>
auto find_arrays(TomlTable& table) {
  std::string name;
  if (table.data() != nullptr && table.has_text("file")) table.read("file", name);
  const auto* const all =
      table.data() == nullptr ? nullptr : &PrimitiveKind<Primitive>::of(*table.data());
  return find_data(all, name);
}

/// Reads materials, and the objects of a scene and its groups: first read_materials(), then
/// start_groups() and load_particles() of all, then the others.
class TomlObjects final : private TomlNames {
 public:
  /// Scene, error and options must outlive it.
  TomlObjects(Scene& scene, FirstError& error, const SceneFileOptions& options)
      : scene_(scene), error_(error), options_(options) {}

  /// The scene may have materials already, by whose names others can be refused.
  void read_materials(std::vector<TomlTable> tables);

  /// Gives every group its number: instances may name groups that come later.
  void start_groups(const std::vector<TomlTable>& tables);
  /// Reads the files of the tables [[particles]]. They become spheres with the other objects.
  /// `may_stream`: where they are all spheres of the scene, their file may stay their source.
  void load_particles(ObjectTables& tables, bool may_stream = false);
  /// The group's table has its origin by now, one of those of all groups.
  void read_group(std::size_t group, ObjectTables& tables, const std::vector<Vec3d>& origins);
  void read_scene(ObjectTables& tables, const std::vector<Vec3d>& group_origins);

  /// Reports what find_instance_problem() finds at the instance's table, and an error if there is
  /// no memory for the primitives that the instances show.
  void check_instances();

  /// LoadedScene::source.
  [[nodiscard]] const std::shared_ptr<ParticleSource>& source() const { return source_; }

  /// What the files of particles held, and what was decided for the user.
  [[nodiscard]] const std::vector<ParticleFacts>& facts() const { return facts_; }
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  /// Where an instance was read.
  struct InstanceTable {
    std::optional<std::size_t> group;  ///< as in InstanceProblem
    std::size_t instance;
    TomlTable table;
  };

  template <class Owner>
  void read_spheres(std::vector<ObjectTables::Spheres>& tables, Owner& owner);
  void read_sphere(TomlTable& table, std::vector<Sphere>& spheres);
  /// Spheres or capsules of a file, or in memory.
  template <class Primitive>
  void read_bulk(TomlTable& table, std::vector<Primitive>& primitives);
  template <class Arrays, class Primitive>
  void add_arrays(TomlTable& table, const Arrays& arrays, std::vector<Primitive>& primitives);
  template <class Primitive>
  void color_bulk(TomlTable& table, const SphereColors& colors, const std::string& path,
                  std::span<Primitive> primitives);
  template <class Owner>
  void add_particles(TomlTable& table, std::optional<TomlParticles>& particles, Owner& owner);
  void add_images(TomlTable& table, ParticleSpheres particles);
  template <class Owner>
  void read_others(ObjectTables& tables, Owner& owner);
  void read_instances(std::vector<TomlTable>& tables, std::optional<std::size_t> group,
                      const std::vector<Vec3d>& origins, std::vector<Instance>& instances);
  /// Reads a struct that may refer to materials and groups, with these keys required.
  template <class T>
  T read_checked(TomlTable& table, std::initializer_list<std::string_view> required = {});
  std::uint32_t group_of(TomlTable& table) override;
  std::uint32_t material_of(TomlTable& table) override;
  MaterialRef colored_material_of(TomlTable& table) override;
  /// The material of primitives whose colours `key` gives.
  std::uint32_t colorable_material_of(TomlTable& table, const char* key);

  std::uint32_t ghost_material_of(TomlTable& table, std::uint32_t material);

  /// The material of objects that name none, added to the scene for the first of them.
  struct DefaultMaterial {
    const char* name;
    Matte matte;
    std::optional<std::uint32_t> id{};
  };
  std::uint32_t add(DefaultMaterial& material);

  Scene& scene_;
  FirstError& error_;
  const SceneFileOptions& options_;
  std::vector<ParticleFacts> facts_;
  std::shared_ptr<ParticleSource> source_;
  std::vector<std::string> notes_;
  std::map<std::string, std::uint32_t> material_ids_;
  std::map<std::string, std::uint32_t> group_ids_;
  DefaultMaterial default_material_{"default", Matte{}};
  /// Darker, so that a sphere stands out from its floor.
  DefaultMaterial default_plane_material_{"default plane", Matte{gray(0.45F)}};
  DefaultMaterial* default_ = &default_material_;  ///< of the objects that are read now
  std::vector<InstanceTable> instance_tables_;
};

}  // namespace boule
