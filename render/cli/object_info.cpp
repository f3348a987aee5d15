#include "render/cli/object_info.h"

#include <algorithm>

#include "render/cli/shown_values.h"
#include "render/prepare/default_camera.h"

namespace boule::cli {
namespace {

/// The first few things of a list.
template <class Thing, class Describe>
Json describe_first(const std::vector<Thing>& things, const Describe& describe) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(things.size(), most_told); ++i) {
    list.push_back(describe(things[i]));
  }
  return list;
}

Json describe_instances(const Scene& scene, const std::vector<Instance>& instances) {
  return describe_first(instances, [&](const Instance& instance) {
    Json json = {{"group", scene.groups[instance.group].name},
                 {"translate", shown(instance.translate)},
                 {"rotate", shown(instance.rotate)},
                 {"scale", shown(instance.scale)}};
    if (instance.material) json["material"] = scene.materials[*instance.material].name;
    return json;
  });
}

Json describe_spheres(const Scene& scene, const std::vector<Sphere>& spheres) {
  return describe_first(spheres, [&](const Sphere& sphere) -> Json {
    return {{"center", shown(sphere.center)},
            {"radius", shown(sphere.radius)},
            {"material", scene.materials[sphere.material].name}};
  });
}

Json describe_planes(const Scene& scene, const std::vector<Plane>& planes) {
  return describe_first(planes, [&](const Plane& plane) -> Json {
    return {{"point", shown(plane.point)},
            {"normal", shown(plane.normal)},
            {"material", scene.materials[plane.material].name}};
  });
}

}  // namespace

Json spheres_info(const Scene& scene) { return describe_spheres(scene, scene.spheres); }
Json planes_info(const Scene& scene) { return describe_planes(scene, scene.planes); }
Json instances_info(const Scene& scene) { return describe_instances(scene, scene.instances); }

Json groups_info(const Scene& scene) {
  Json list = Json::array();
  for (const Group& group : scene.groups) {
    list.push_back({{"name", group.name},
                    {"spheres", group.spheres.size()},
                    {"planes", group.planes.size()},
                    {"instances", group.instances.size()},
                    {"first_spheres", describe_spheres(scene, group.spheres)},
                    {"first_planes", describe_planes(scene, group.planes)},
                    {"first_instances", describe_instances(scene, group.instances)}});
  }
  return list;
}

Json bounds_info(const std::vector<Sphere>& spheres) {
  if (spheres.empty()) return nullptr;
  const auto [low, high] = bounds_of(spheres);
  return {{"min", shown(vec_cast<float>(low))}, {"max", shown(vec_cast<float>(high))}};
}

}  // namespace boule::cli
