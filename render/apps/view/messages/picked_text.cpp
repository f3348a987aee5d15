#include "render/apps/view/messages/picked_text.h"

#include <cmath>

#include "core/math/geometry.h"
#include "render/apps/view/messages/message_keys.h"

namespace boule::view {
namespace {

/// A number, or null where JSON has none.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

/// The shortest text that is the float again is not needed here: all digits are there.
Json color(const Color& c) {
  return {number(double{c.r}), number(double{c.g}), number(double{c.b})};
}

Json vector(const Vec3d& v) { return {number(v.x), number(v.y), number(v.z)}; }

const char* kind_name(RayKind kind) {
  constexpr const char* kinds[] = {"primary", "reflection", "refraction", "shadow"};
  return kinds[static_cast<std::size_t>(kind)];
}

/// The name of the material that was hit.
Json material_name(const PickedPixel& pixel, const Hit& hit) {
  const std::size_t material = pixel.scene.material_ref(hit).index();
  const auto& names = pixel.loaded.scene.materials;
  return material < names.size() ? Json(names[material].name) : Json();
}

Json hit_json(const PickedPixel& pixel, const RecordedRay& primary) {
  if (primary.hit.id == no_primitive) return nullptr;
  const PreparedScene& scene = pixel.scene;
  const Vec3d& origin = pixel.loaded.origin;
  const Surface surface = find_surface(scene, primary.ray, primary.met);
  const std::uint32_t id = scene.primitive_id(primary.hit);
  const bool is_sphere = scene.is_sphere(primary.hit), is_capsule = scene.is_capsule(primary.hit);
  Json json = {
      {"primitive", id},
      {"kind", is_sphere    ? "sphere"
               : is_capsule ? "capsule"
                            : "plane"},
      {"material", material_name(pixel, primary.hit)},
      {"t", number(primary.hit.t)},
      {"depth", number(dot(surface.point - scene.camera_view.eye, scene.camera_view.forward))},
      {"position", vector(surface.point + origin)},
      {"normal", vector(surface.normal)}};
  if (is_sphere) {
    const Sphere sphere = scene.geometry.sphere(primary.hit.slot);
    json["center"] = vector(vec_cast<double>(sphere.center) + origin);
    json["radius"] = number(double{sphere.radius});
  } else if (is_capsule) {
    const Capsule capsule = scene.geometry.capsule(primary.hit.slot);
    json["a"] = vector(vec_cast<double>(capsule.a) + origin);
    json["b"] = vector(vec_cast<double>(capsule.b) + origin);
    json["radius"] = number(double{capsule.radius});
  }
  return json;
}

Json ray_json(const PickedPixel& pixel, const RecordedRay& ray, const Color& returned) {
  const Vec3d& origin = pixel.loaded.origin;
  const bool met = ray.hit.id != no_primitive;
  const double size = length(vec_cast<double>(ray.ray.dir));
  Json json = {{"kind", kind_name(ray.kind)},
               {"parent", ray.parent < 0 ? Json() : Json(ray.parent)},
               {"depth", ray.depth},
               {"t", met ? number(ray.hit.t) : Json()},
               {"distance", met ? number(ray.hit.t * size) : Json()},
               {"primitive", met ? Json(pixel.scene.primitive_id(ray.hit)) : Json()},
               {"material", met ? material_name(pixel, ray.hit) : Json()},
               {"weight", color(ray.weight)},
               {"throughput", color(ray.throughput)},
               {"own", color(ray.own)},
               {"returned", color(returned)},
               {"origin", vector(ray.ray.org + origin)},
               {"direction", vector(vec_cast<double>(ray.ray.dir))}};
  if (ray.kind != RayKind::shadow) return json;
  json["light"] = ray.light;
  json["blocked"] = met;
  return json;
}

}  // namespace

std::string picked_text(const PickedPixel& pixel) {
  const auto& rays = pixel.record.rays();
  const auto returned = pixel.record.returned();
  Json list = Json::array();
  for (std::size_t i = 0; i < rays.size(); ++i)
    list.push_back(ray_json(pixel, rays[i], returned[i]));
  const Color seen = rays.empty() ? Color{} : pixel.record.total();
  const Json json = {{"type", "picked"},
                     {"id", pixel.message.id},
                     {"pane", pixel.message.pane},
                     {"x", pixel.message.x},
                     {"y", pixel.message.y},
                     {"hit", rays.empty() ? Json() : hit_json(pixel, rays.front())},
                     {"color", color(seen)},
                     {"film_weight", number(double{pixel.weight})},
                     {"rays", list}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace boule::view
