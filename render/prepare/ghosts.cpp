#include "render/prepare/ghosts.h"

#include <algorithm>
#include <utility>

namespace boule {
namespace {

bool is_ghost(const NamedMaterial& named) { return std::holds_alternative<Ghost>(named.material); }

/// Moves the ghosts among primitives to a list of their own. `ids` gets the places of the others,
/// whose groups stay.
template <class Primitive>
std::vector<Primitive> split(std::vector<Primitive>& all, const Scene& scene,
                             std::vector<std::uint32_t>& groups, std::vector<std::uint32_t>& ids) {
  std::vector<Primitive> ghosts;
  std::size_t grouped = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_ghost(scene.materials[all[i].material.index()])) {
      ghosts.push_back(all[i]);
      continue;
    }
    const std::size_t place = ids.size();
    if (i < groups.size()) groups[grouped++] = groups[i];
    all[place] = all[i];
    ids.push_back(static_cast<std::uint32_t>(i));
  }
  groups.resize(grouped);
  all.resize(ids.size());
  return ghosts;
}

Status check_kinds(const Scene& scene) {
  for (const Plane& plane : scene.planes) {
    const NamedMaterial& material = scene.materials[plane.material.index()];
    if (is_ghost(material))
      return Diagnostic::about("material." + material.name, "planes cannot be ghosts");
  }
  if (!scene.packed) return {};
  return Diagnostic::about("material", "packed scenes have no ghosts");
}

}  // namespace

Result<Ghosts> take_ghosts(Scene& scene, Scene& ghosts) {
  if (auto done = check_kinds(scene); !done) return done.error();
  Ghosts taken;
  taken.spheres = static_cast<std::uint32_t>(scene.spheres.size());
  OutlineGroups& groups = scene.outline_groups;
  ghosts.spheres = split(scene.spheres, scene, groups.spheres, taken.sphere_ids);
  ghosts.capsules = split(scene.capsules, scene, groups.capsules, taken.capsule_ids);
  return taken;
}

}  // namespace boule
