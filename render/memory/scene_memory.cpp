#include "render/memory/scene_memory.h"

#include <string>

#include "core/scene/instances.h"
#include "render/memory/available_memory.h"

namespace boule {

namespace {

/// The same for groups that are not written out: the trees take the place of their spheres.
Status check_shared_memory(const Scene& scene, const std::vector<ShownGroup>& groups) {
  std::uint64_t spheres = scene.spheres.size();
  for (const Group& group : scene.groups) spheres += group.spheres.size();
  constexpr std::uint64_t bytes_of_part = 512;
  const std::uint64_t capsules = count_primitives(scene).capsules;
  return check_memory(
      bytes_of_tree(spheres) + bytes_of_capsule_tree(capsules) + groups.size() * bytes_of_part,
      std::to_string(spheres) + " spheres, in groups that are shown " +
          std::to_string(groups.size()) + " times, need",
      "instance");
}

}  // namespace

Status check_scene_memory(const Scene& scene) {
  if (find_reference_problem(scene)) return {};
  if (const auto groups = groups_to_share(scene)) return check_shared_memory(scene, *groups);
  PrimitiveCount count = count_primitives(scene);
  if (scene.packed) count.spheres -= scene.packed->count;  // they are in their tree already
  std::uint64_t others = 0;
  each_other_kind([&](auto kind) {
    others += (kind.of(count) - kind.of(scene).size()) * sizeof(typename decltype(kind)::Primitive);
  });
  // The scene's own spheres are in memory already.
  const std::uint64_t bytes = bytes_of_tree(count.spheres) + bytes_of_capsule_tree(count.capsules) +
                              others - bytes_of_spheres(scene.spheres.size());
  const bool instances = !scene.instances.empty();
  const char* const kinds = count.capsules > 0 ? " primitives" : " spheres and planes";
  return check_memory(bytes,
                      std::to_string(count.total()) + kinds +
                          (instances ? ", with those of the instances, need" : " need"),
                      instances ? "instance" : "");
}

Status check_reference_memory(const Scene& scene) {
  if (find_reference_problem(scene) || !groups_to_share(scene)) return {};
  const PrimitiveCount count = count_primitives(scene);
  if (count.total() > max_primitives) {
    return Diagnostic::about("instance", "shows more than " + std::to_string(max_primitives) +
                                             " primitives: solver reference has no ids for them");
  }
  return check_memory(bytes_of_spheres(count.spheres) + count.spheres * sizeof(std::uint32_t),
                      std::to_string(count.spheres) + " spheres for solver reference need",
                      "instance");
}

}  // namespace boule
