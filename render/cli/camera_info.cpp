#include "render/cli/camera_info.h"

#include <optional>
#include <variant>
#include <vector>

#include "render/cli/shown_values.h"

namespace boule::cli {
namespace {

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
  json["fov_axis"] = fov_axis_name(camera.fov_axis);
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

Json describe_surfaces(const std::vector<LensSurface>& surfaces) {
  Json list = Json::array();
  for (const LensSurface& surface : surfaces) {
    list.push_back({{"radius", shown(surface.radius)},
                    {"thickness", shown(surface.thickness)},
                    {"index", shown(surface.index)},
                    {"aperture", shown(surface.aperture)}});
  }
  return list;
}

/// That of the stop as wide as it is.
std::optional<double> f_number_of(const std::vector<LensSurface>& surfaces) {
  const auto stop = find_stop(surfaces);
  if (!stop) return std::nullopt;
  return shown(
      static_cast<float>(stop_diameter(surfaces, *stop, double{surfaces[*stop].aperture})));
}

Json describe(const LensCamera& camera) {
  Json json = {{"type", "lens"}};
  add_pose(json, camera.pose);
  json["surfaces"] = camera.surfaces.size();
  json["elements"] = describe_surfaces(camera.surfaces);
  if (const auto number = f_number_of(camera.surfaces)) json["f_number"] = *number;
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

}  // namespace

Json camera_info(const Camera& camera) {
  return std::visit([](const auto& any) { return describe(any); }, camera);
}

}  // namespace boule::cli
