#include "render/apps/cli/info/camera_info.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "render/apps/cli/info/field_info.h"

namespace boule::cli {
namespace {

/// The distance that is sharp: the camera's focus, or that of its look_at.
template <class Kind>
double shown_focus(const Kind& camera) {
  return shown(static_cast<float>(focus_of(camera.pose, camera.focus)));
}

/// The f-number that the stop has as wide as it is.
std::optional<double> f_number_of(const std::vector<LensSurface>& surfaces) {
  const auto stop = find_stop(surfaces);
  if (!stop) return std::nullopt;
  return shown(
      static_cast<float>(stop_diameter(surfaces, *stop, double{surfaces[*stop].aperture})));
}

void add_elements(Json& json, const std::vector<LensSurface>& surfaces) {
  json["surfaces"] = surfaces.size();
  json["elements"] = Json::array();
  for (const LensSurface& surface : surfaces) json["elements"].push_back(fields_info(surface));
  if (const auto number = f_number_of(surfaces)) json["f_number"] = *number;
  json["focal_length"] = shown(static_cast<float>(focal_length(surfaces)));
}

template <class Kind>
Json describe(const Kind& camera, const Vec3d& origin) {
  return kind_info(camera, origin);
}

Json describe(const ThinLensCamera& camera, const Vec3d& origin) {
  Json json = kind_info(camera, origin);
  json["focus"] = shown_focus(camera);
  return json;
}

Json describe(const LensCamera& camera, const Vec3d& origin) {
  Json json = {{"type", fields<LensCamera>.type}};
  FieldInfo(json, nullptr, origin).add(camera.pose);
  add_elements(json, camera.surfaces);
  FieldInfo(json).add(camera);
  json["focus"] = shown_focus(camera);
  return json;
}

}  // namespace

Json camera_info(const Camera& camera, const Vec3d& origin) {
  return std::visit([&](const auto& any) { return describe(any, origin); }, camera);
}

}  // namespace boule::cli
