#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/scene/group.h"
#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/files/scene_file/loaded/scene_origin.h"
#include "render/files/scene_file/toml/toml_objects.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// Finds where the spheres and capsules of a scene and its groups are, before any of them is
/// rounded. What is wrong in the tables is told when they are read.
class TomlExtents {
 public:
  /// `groups` are the tables of the groups, with their objects in the same order. The particles are
  /// loaded. All must outlive it.
  TomlExtents(const std::vector<TomlTable>& groups, std::vector<ObjectTables>& objects,
              const SceneFileOptions& options);

  /// The extents of the objects of a scene or group, those of its instances among them.
  SceneExtents of(ObjectTables& objects) { return parts_of(objects, 0); }

 private:
  SceneExtents parts_of(ObjectTables& objects, std::size_t depth);
  SphereExtent of_spheres(ObjectTables::Spheres& spheres);
  template <class Primitive>
  SphereExtent of_file(TomlTable& table);
  SphereExtent of_instance(TomlTable& table, std::size_t depth);
  const SphereExtent& of_group(std::size_t group, std::size_t depth);

  std::map<std::string, std::size_t> ids_;
  std::vector<ObjectTables>& objects_;
  const SceneFileOptions& options_;
  std::vector<std::optional<SphereExtent>> known_;  ///< by group
};

/// Reads the key `origin` of a scene: a point, or "auto", which is the default: nothing. Errors are
/// reported through the table.
std::optional<Vec3d> read_origin(TomlTable& root);

}  // namespace boule
