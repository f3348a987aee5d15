#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "core/scene/lens.h"
#include "core/scene/primitive.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/scene_file/loaded/scene_origin.h"
#include "render/image/image.h"

namespace boule {

/// Spheres in memory that a scene has like those of a file. All are valid by themselves.
struct SphereArrays {
  /// Rounded, with the centres counted from `base`, unless `centers` has these.
  std::vector<Sphere> spheres;
  Vec3d base{};
  /// Of double precision, by sphere; empty: those of the spheres.
  std::vector<Vec3d> centers{};
  /// The names of the materials that the spheres have by index; empty: all have the table's.
  std::vector<std::string> materials{};
  bool has_colors = false;  ///< any sphere has a colour of its own

  /// Where they are, before they are rounded.
  [[nodiscard]] SphereExtent extent(const ParallelFor& parallel_for) const;
  /// Appends the spheres, each rounded once, with centres counted from `origin`. An error, and no
  /// sphere more, if a centre is then too large for a float; it names the sphere from 0 ("row 17").
  /// Throws std::bad_alloc.
  Status append_to(std::vector<Sphere>& target, const Vec3d& origin,
                   const ParallelFor& parallel_for = serial_for) const;
};

/// The same for capsules.
struct CapsuleArrays {
  /// Rounded, with the ends counted from `base`, unless `ends` has these.
  std::vector<Capsule> capsules;
  Vec3d base{};
  /// Of double precision, both of each capsule; empty: those of the capsules.
  std::vector<Vec3d> ends{};
  std::vector<std::string> materials{};
  bool has_colors = false;

  [[nodiscard]] SphereExtent extent(const ParallelFor& parallel_for) const;
  Status append_to(std::vector<Capsule>& target, const Vec3d& origin,
                   const ParallelFor& parallel_for = serial_for) const;
};

/// What stands in memory in place of files, by the names that a scene gives it.
struct SceneData {
  std::map<std::string, std::shared_ptr<const SphereArrays>> spheres{};
  std::map<std::string, std::shared_ptr<const CapsuleArrays>> capsules{};
  std::map<std::string, std::shared_ptr<ParticleFile>> particles{};
  std::map<std::string, std::shared_ptr<const Image>> pictures{};
  std::map<std::string, std::shared_ptr<const std::vector<LensSurface>>> lenses{};
};

/// What has this name, or null.
template <class T>
const T* find_data(const std::map<std::string, std::shared_ptr<T>>* all, const std::string& name) {
  if (all == nullptr) return nullptr;
  const auto found = all->find(name);
  return found == all->end() ? nullptr : found->second.get();
}

}  // namespace boule
