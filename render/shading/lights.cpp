#include "render/shading/lights.h"

namespace boule {

namespace {

ShadowTarget point_target(const Vec3f& p) {
  return {false, {double{p.x}, double{p.y}, double{p.z}}, {}};
}
ShadowTarget target_of(const PointLight& light) { return point_target(light.position); }
ShadowTarget target_of(const SphereLight& light) { return point_target(light.center); }
ShadowTarget target_of(const DirectionalLight& light) {
  const Vec3d to_light = normalize(-vec_cast<double>(light.direction));
  const Vec3f dir = -light.direction;
  return {true, {to_light.x, to_light.y, to_light.z}, {dir.x, dir.y, dir.z}};
}

}  // namespace

ShadowTarget shadow_target(const Light& light) {
  return std::visit([](const auto& any) { return target_of(any); }, light);
}

Coherence shadow_coherence(const Light& light) {
  return std::holds_alternative<DirectionalLight>(light) ? Coherence::common_direction
                                                         : Coherence::common_end;
}

}  // namespace boule
