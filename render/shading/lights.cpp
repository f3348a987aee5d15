#include "render/shading/lights.h"

namespace boule {

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

Coherence shadow_coherence(const Light& light) {
  return std::holds_alternative<DirectionalLight>(light) ? Coherence::common_direction
                                                         : Coherence::common_end;
}

}  // namespace boule
