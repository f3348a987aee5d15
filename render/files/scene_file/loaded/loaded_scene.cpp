#include "render/files/scene_file/loaded/loaded_scene.h"

namespace boule {

Vec3d shown_origin(const LoadedScene& loaded, const Instance& instance, const Vec3d& origin) {
  Similarity by = transform_of(instance);
  by.shift = {};
  return origin - by.apply(loaded.origin_of(instance.group));
}

}  // namespace boule
