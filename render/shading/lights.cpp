#include "render/shading/lights.h"

namespace boule {

namespace {

LightPlace point_place(const Vec3f& p) {
  return {false, {double{p.x}, double{p.y}, double{p.z}}, {}};
}
LightPlace place_of_any(const PointLight& light) { return point_place(light.position); }
LightPlace place_of_any(const SphereLight& light) { return point_place(light.center); }
LightPlace place_of_any(const DirectionalLight& light) {
  const Vec3d to_light = direction_to(light, {});
  const Vec3f way = -light.direction;
  return {true, {to_light.x, to_light.y, to_light.z}, {way.x, way.y, way.z}};
}

}  // namespace

LightSample sample_light(const Light& light, const Vec3d& point) {
  return std::visit(
      [&](const auto& any) -> LightSample {
        return {direction_to(any, point), intensity_at(any, point)};
      },
      light);
}

Ray shadow_ray(const Light& light, const Surface& surface) {
  const Departure departure = depart(surface, Side::viewer);
  const auto way = [&](const auto& any) { return way_to(any, departure.org); };
  return from_surface(std::visit(way, light), departure);
}

LightPlace place_of(const Light& light) {
  return std::visit([](const auto& any) { return place_of_any(any); }, light);
}

Coherence shadow_coherence(const Light& light) {
  return std::holds_alternative<DirectionalLight>(light) ? Coherence::common_direction
                                                         : Coherence::common_end;
}

}  // namespace boule
