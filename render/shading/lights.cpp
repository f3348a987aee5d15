#include "render/shading/lights.h"

namespace boule {

namespace {

LightPlace point_place(const Vec3f& p) {
  return {false, {double{p.x}, double{p.y}, double{p.z}}, {}};
}
LightPlace place_of_any(const PointLight& light) { return point_place(light.position); }
LightPlace place_of_any(const SphereLight& light) { return point_place(light.center); }
LightPlace place_of_any(const DirectionalLight& light) {
  const Vec3d to_light = normalize(-vec_cast<double>(light.direction));
  const Vec3f way = -light.direction;
  return {true, {to_light.x, to_light.y, to_light.z}, {way.x, way.y, way.z}};
}

}  // namespace

LightPlace place_of(const Light& light) {
  return std::visit([](const auto& any) { return place_of_any(any); }, light);
}

Coherence shadow_coherence(const Light& light) {
  return std::holds_alternative<DirectionalLight>(light) ? Coherence::common_direction
                                                         : Coherence::common_end;
}

}  // namespace boule
