#include "render/memory/scene_memory.h"

#include <string>

#include "core/scene/instances.h"
#include "render/memory/available_memory.h"

namespace boule {

Status check_scene_memory(const Scene& scene) {
  if (find_reference_problem(scene)) return std::nullopt;
  PrimitiveCount count = count_primitives(scene);
  if (scene.packed) count.spheres -= scene.packed->count;  // they are in their tree already
  const std::uint64_t planes = count.planes - scene.planes.size();
  // The scene's own spheres are in memory already.
  const std::uint64_t bytes = bytes_of_tree(count.spheres) + planes * sizeof(Plane) -
                              bytes_of_spheres(scene.spheres.size());
  const bool instances = !scene.instances.empty();
  return check_memory(bytes,
                      std::to_string(count.total()) + " spheres and planes" +
                          (instances ? ", with those of the instances, need" : " need"),
                      instances ? "instance" : "");
}

}  // namespace boule
