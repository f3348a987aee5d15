#include "render/cli/scene_info.h"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "core/scene/instances.h"
#include "render/prepare/default_view.h"
#include "render/renderer/scene_hash.h"

namespace boule::cli {
namespace {

using Json = nlohmann::ordered_json;

/// The double that prints as short as the float does: 0.1, not 0.10000000149011612.
double shown(float x) {
  const std::string text = fmt::format("{}", x);
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

Json shown(const Vec3f& v) { return {shown(v.x), shown(v.y), shown(v.z)}; }
Json shown(const Color& c) { return {shown(c.r), shown(c.g), shown(c.b)}; }

void add_pose(Json& json, const CameraPose& pose) {
  json["eye"] = shown(pose.eye);
  json["look_at"] = shown(pose.look_at);
  json["up"] = shown(pose.up);
}

/// What cameras with a field of view have in common.
template <class Kind>
Json describe_fov(const char* type, const Kind& camera) {
  Json json = {{"type", type}};
  add_pose(json, camera.pose);
  json["fov"] = shown(camera.fov);
  json["fov_axis"] = camera.fov_axis == FovAxis::x   ? "x"
                     : camera.fov_axis == FovAxis::y ? "y"
                                                     : "max";
  return json;
}

Json describe(const PinholeCamera& camera) { return describe_fov("pinhole", camera); }
Json describe(const FisheyeCamera& camera) { return describe_fov("fisheye", camera); }

Json describe(const ThinLensCamera& camera) {
  Json json = describe_fov("thin_lens", camera);
  json["aperture"] = shown(camera.aperture);
  json["focus"] = shown(static_cast<float>(focus_of(camera.pose, camera.focus)));
  return json;
}

Json describe(const LensCamera& camera) {
  Json json = {{"type", "lens"}};
  add_pose(json, camera.pose);
  json["surfaces"] = camera.surfaces.size();
  json["focal_length"] = shown(static_cast<float>(focal_length(camera.surfaces)));
  json["film_width"] = shown(camera.film_width);
  json["scale"] = shown(camera.scale);
  json["focus"] = shown(static_cast<float>(focus_of(camera.pose, camera.focus)));
  return json;
}

Json describe(const OrthographicCamera& camera) {
  Json json = {{"type", "orthographic"}};
  add_pose(json, camera.pose);
  json["height"] = shown(camera.height);
  return json;
}

Json describe(const ConstantBackground& background) {
  return {{"type", "constant"}, {"color", shown(background.color)}};
}

Json describe(const GradientBackground& background) {
  return {{"type", "gradient"},
          {"bottom", shown(background.bottom)},
          {"top", shown(background.top)},
          {"up", shown(background.up)}};
}

Json describe(const EnvironmentBackground& background) {
  return {{"type", "environment"},
          {"size", {background.width, background.height}},
          {"rotation", shown(background.rotation)}};
}

Json describe(const PointLight& light) {
  return {{"type", "point"},
          {"position", shown(light.position)},
          {"intensity", shown(light.intensity)},
          {"falloff", light.falloff == Falloff::none ? "none" : "inverse_square"}};
}

Json describe(const DirectionalLight& light) {
  return {{"type", "directional"},
          {"direction", shown(light.direction)},
          {"intensity", shown(light.intensity)}};
}

Json describe(const SphereLight& light) {
  return {{"type", "sphere"},
          {"center", shown(light.center)},
          {"radius", shown(light.radius)},
          {"radiance", shown(light.radiance)}};
}

/// A material under its name.
struct DescribeMaterial {
  std::string name;

  [[nodiscard]] Json start(const char* type) const { return {{"name", name}, {"type", type}}; }
  Json operator()(const Matte& m) const {
    Json json = start("matte");
    json["color"] = shown(m.color);
    return json;
  }
  Json operator()(const Plastic& m) const {
    Json json = start("plastic");
    json.update({{"color", shown(m.color)},
                 {"specular", shown(m.specular)},
                 {"shininess", shown(m.shininess)},
                 {"reflect", shown(m.reflect)}});
    return json;
  }
  Json operator()(const Metal& m) const {
    Json json = start("metal");
    json["color"] = shown(m.color);
    return json;
  }
  Json operator()(const Glass& m) const {
    Json json = start("glass");
    json.update({{"color", shown(m.color)}, {"ior", shown(m.ior)}});
    return json;
  }
  Json operator()(const Emissive& m) const {
    Json json = start("emissive");
    json["radiance"] = shown(m.radiance);
    return json;
  }
  Json operator()(const Phong& m) const {
    Json json = start("phong");
    json.update({{"color", shown(m.color)},
                 {"ka", shown(m.ka)},
                 {"kd", shown(m.kd)},
                 {"ks", shown(m.ks)},
                 {"shininess", shown(m.shininess)},
                 {"transmission", shown(m.transmission)},
                 {"ior", shown(m.ior)}});
    return json;
  }
};

/// The box around all spheres, rounded to float; null where there is none; planes have no end.
Json describe_bounds(const std::vector<Sphere>& spheres) {
  if (spheres.empty()) return nullptr;
  const auto [low, high] = bounds_of(spheres);
  return {{"min", shown(vec_cast<float>(low))}, {"max", shown(vec_cast<float>(high))}};
}

template <class Variant>
Json describe_any(const Variant& one_of) {
  return std::visit([](const auto& any) { return describe(any); }, one_of);
}

/// The camera and the lights as they will be rendered, with a note where the scene has none.
void add_view(Json& json, const Scene& scene) {
  Json notes = Json::array(), lights = Json::array();
  const Camera camera =
      scene.camera ? *scene.camera : default_camera(scene, scene.image.width, scene.image.height);
  if (!scene.camera) notes.push_back("no camera in the scene: framed on the objects");
  for (const Light& light : scene.lights) lights.push_back(describe_any(light));
  if (lacks_light(scene, scene.render.method)) {
    lights.push_back(describe(light_at_eye(camera)));
    notes.push_back("no light in the scene: one white point light at the eye");
  }
  json["camera"] = describe_any(camera);
  if (scene.distortion) {
    json["camera"]["distortion"] = {{"size", {scene.distortion->width, scene.distortion->height}}};
  }
  json["background"] = describe_any(scene.background);
  json["ambient"] = shown(scene.ambient);
  json["lights"] = std::move(lights);
  json["notes"] = std::move(notes);
}

}  // namespace

nlohmann::ordered_json scene_info(LoadedScene loaded, const std::string& path) {
  Scene& scene = loaded.scene;
  const std::size_t groups = scene.groups.size(), instances = scene.instances.size();
  expand_instances(scene);
  Json json = {{"schema", 1},
               {"file", path},
               {"hash", fmt::format("{:016x}", scene_hash(scene))},
               {"size", {scene.image.width, scene.image.height}},
               {"spp", scene.image.spp},
               {"method", scene.render.method == Method::path ? "path" : "whitted"},
               {"max_depth", scene.render.max_depth},
               {"spheres", scene.spheres.size()},
               {"planes", scene.planes.size()},
               {"groups", groups},
               {"instances", instances},
               {"bounds", describe_bounds(scene.spheres)}};
  add_view(json, scene);
  Json materials = Json::array();
  for (const NamedMaterial& named : scene.materials) {
    materials.push_back(std::visit(DescribeMaterial{named.name}, named.material));
  }
  json["materials"] = std::move(materials);
  json["warnings"] = loaded.warnings;
  return json;
}

}  // namespace boule::cli
