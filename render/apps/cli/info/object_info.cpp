#include "render/apps/cli/info/object_info.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/scene/instances.h"
#include "render/apps/cli/info/field_info.h"
#include "render/prepare/default_camera.h"

namespace boule::cli {
namespace {

/// The first few things of a list.
template <class Thing>
Json first_info(const Scene& scene, const std::vector<Thing>& things, const Vec3d& origin) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(things.size(), most_told); ++i) {
    list.push_back(fields_info(things[i], &scene, origin));
  }
  return list;
}

Json instances_info(const LoadedScene& loaded, const std::vector<Instance>& all,
                    const Vec3d& origin) {
  Json list = Json::array();
  for (std::size_t i = 0; i < all.size() && i < most_told; ++i)
    list.push_back(fields_info(all[i], &loaded.scene, shown_origin(loaded, all[i], origin)));
  return list;
}

}  // namespace

Json spheres_info(const Scene& scene, const Vec3d& origin) {
  if (scene.packed) return first_info(scene, scene.packed->first, origin);
  if (scene.spheres.size() >= most_told) return first_info(scene, scene.spheres, origin);
  std::vector<Sphere> first = scene.spheres;
  visit_shown_groups(scene, [&](const ShownGroup& shown) {
    for (const Sphere& one : scene.groups[shown.group].spheres) {
      if (first.size() == most_told) return;
      first.push_back(transformed(one, shown.transform, shown.material));
    }
  });
  return first_info(scene, first, origin);
}
void add_others(Json& json, const Scene& scene, const Vec3d& origin) {
  each_other_kind([&](auto kind) {
    json[std::string("first_") + kind.plural] = first_info(scene, kind.of(scene), origin);
  });
}
Json clips_info(const Scene& scene, const Vec3d& origin) {
  return first_info(scene, scene.clips, origin);
}
Json instances_info(const LoadedScene& loaded) {
  return instances_info(loaded, loaded.scene.instances, loaded.origin);
}

Json groups_info(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  Json list = Json::array();
  for (std::size_t i = 0; i < scene.groups.size(); ++i) {
    const Group& group = scene.groups[i];
    const Vec3d origin = loaded.origin_of(i);
    Json one = {{"name", group.name}};
    each_kind([&](auto kind) { one[kind.plural] = kind.of(group).size(); });
    one["instances"] = group.instances.size();
    each_kind([&](auto kind) {
      one[std::string("first_") + kind.plural] = first_info(scene, kind.of(group), origin);
    });
    one["first_instances"] = instances_info(loaded, group.instances, origin);
    list.push_back(std::move(one));
  }
  return list;
}

Json bounds_info(const Scene& scene, const Vec3d& origin) {
  if (count_primitives(scene).finite() == 0) return nullptr;
  const auto [low, high] = bounds_of(scene);
  return {{"min", shown(vec_cast<float>(low), origin)},
          {"max", shown(vec_cast<float>(high), origin)}};
}

}  // namespace boule::cli
