#include "render/apps/cli/info/scene_info.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "core/scene/instances.h"
#include "render/apps/cli/info/camera_info.h"
#include "render/apps/cli/info/field_info.h"
#include "render/apps/cli/info/object_info.h"
#include "render/frame/scheduler.h"
#include "render/prepare/default_camera.h"
#include "render/prepare/default_light.h"
#include "render/renderer/scene_hash.h"

namespace boule::cli {
namespace {

/// Each with the number of primitives that are made of it.
Json materials_info(const Scene& scene) {
  std::vector<std::uint64_t> objects(scene.materials.size());
  const auto count = [&objects](const std::vector<Sphere>& spheres, std::uint64_t times) {
    for (const Sphere& sphere : spheres) objects[sphere.material.index()] += times;
  };
  count(scene.spheres, 1);
  std::vector<std::uint64_t> shown_groups(scene.groups.size());
  visit_shown_groups(scene, [&](const ShownGroup& shown) {
    const auto& spheres = scene.groups[shown.group].spheres;
    shown.material ? objects[*shown.material] += spheres.size() : ++shown_groups[shown.group];
  });
  for (std::size_t i = 0; i < shown_groups.size(); ++i)
    count(scene.groups[i].spheres, shown_groups[i]);
  each_other_kind([&](auto kind) {
    for (const auto& one : kind.of(scene)) ++objects[one.material.index()];
  });
  if (scene.packed) {
    for (std::size_t i = 0; i < scene.packed->made_of.size(); ++i)
      objects[i] += scene.packed->made_of[i];
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const NamedMaterial& named = scene.materials[i];
    Json json = {{"name", named.name}};
    json.update(kind_info(named.material));
    json["objects"] = objects[i];
    list.push_back(std::move(json));
  }
  return list;
}

/// A value on one line: numbers with spaces between them, members with commas, what has members
/// itself with semicolons.
std::string inline_text(const Json& value) {
  if (value.empty()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& item : value.items()) {
    const bool is_large = value.is_array() && item.value().is_object();
    if (!text.empty()) text += value.is_object() ? ", " : is_large ? "; " : " ";
    if (value.is_object()) text += item.key() + " ";
    text += inline_text(item.value());
  }
  return text;
}

/// True for a list of things rather than of coordinates: each gets a line.
bool is_list(const std::string& key) {
  for (const char* list : {"data_files", "lights", "materials", "notes", "warnings",
                           "first_spheres", "first_planes", "first_capsules", "clips", "group_list",
                           "first_instances", "species", "columns", "sections"}) {
    if (key == list) return true;
  }
  return false;
}

/// A line; or for a list its name and a line for each element, with lists inside it indented below.
void append_text(std::string& text, const std::string& indent, const std::string& key,
                 const Json& value) {
  const auto append = [&](const std::string& end) { text += indent + key + ": " + end + "\n"; };
  if (!is_list(key)) return append(inline_text(value));
  if (value.empty()) return;
  append(std::to_string(value.size()));
  for (Json one : value) {
    Json lists = Json::object();
    for (const auto& item : one.items()) {
      if (one.is_object() && is_list(item.key())) lists[item.key()] = item.value();
    }
    for (const auto& item : lists.items()) one.erase(item.key());
    text += indent + "  " + inline_text(one) + "\n";
    for (const auto& item : lists.items()) {
      append_text(text, indent + "    ", item.key(), item.value());
    }
  }
}

/// A light by the camera's axes has no points that are counted from the origin.
Json light_info(const Light& light, const Vec3d& origin) {
  const auto frame = std::visit([](const auto& any) { return any.relative_to; }, light);
  return kind_info(light, frame == LightFrame::camera ? Vec3d{} : origin);
}

/// Camera, background and lights as they will be rendered, with a note on what the scene lacks.
void add_surroundings(Json& json, const Scene& scene, const Vec3d& origin) {
  Json notes = Json::array(), lights = Json::array();
  const auto [camera, leaves_out] =
      scene.camera ? DefaultCamera{*scene.camera}
                   : choose_camera(scene, scene.image.width, scene.image.height);
  if (count_primitives(scene).total() == 0) {
    notes.push_back("no objects in the scene: nothing to be hit");
  } else if (!scene.camera) {
    notes.push_back(std::string(camera_note) + (leaves_out ? left_out_note : ""));
  }
  for (const Light& light : scene.lights) lights.push_back(light_info(light, origin));
  if (lacks_light(scene, scene.render.method)) {
    for (const Light& light : default_lights(camera)) lights.push_back(light_info(light, origin));
    notes.push_back(light_note(scene, scene.render.method));
  }
  json["camera"] = camera_info(camera, origin);
  if (scene.distortion) json["camera"]["distortion"] = fields_info(*scene.distortion);
  json["background"] = kind_info(scene.background);
  json["ambient"] = shown(scene.ambient);
  if (scene.backdrop) json["backdrop"] = shown(*scene.backdrop);
  json["lights"] = std::move(lights);
  json["notes"] = std::move(notes);
}

}  // namespace

Json scene_info(LoadedScene loaded, const std::string& path) {
  Scene& scene = loaded.scene;
  const Vec3d& origin = loaded.origin;
  Json groups = groups_info(loaded), instances = instances_info(loaded);
  const std::size_t group_count = scene.groups.size(), instance_count = scene.instances.size();
  const std::uint64_t hash = scene_hash(scene, Scheduler(0).parallel_for());
  share_or_expand(scene);
  Json json = {{"schema", 1},
               {"file", path},
               {"data_files", loaded.data_files},
               {"hash", fmt::format("{:016x}", hash)}};
  FieldInfo(json).add(scene.image);
  FieldInfo(json).add(scene.render);
  const PrimitiveCount count = count_primitives(scene);
  each_kind([&](auto kind) { json[kind.plural] = kind.of(count); });
  json.update({{"groups", group_count},
               {"instances", instance_count},
               {"bounds", bounds_info(scene, origin)},
               {"origin", {origin.x, origin.y, origin.z}}});
  add_surroundings(json, scene, origin);
  json["materials"] = materials_info(scene);
  json["first_spheres"] = spheres_info(scene, origin);
  add_others(json, scene, origin);
  if (!scene.clips.empty()) json["clips"] = clips_info(scene, origin);
  json["group_list"] = std::move(groups);
  json["first_instances"] = std::move(instances);
  for (const std::string& note : loaded.notes) json["notes"].push_back(note);
  json["warnings"] = loaded.warnings;
  return json;
}

std::string scene_info_text(const Json& info) {
  std::string text;
  for (const auto& item : info.items()) {
    if (item.key() != "schema") append_text(text, "", item.key(), item.value());
  }
  return text;
}

}  // namespace boule::cli
