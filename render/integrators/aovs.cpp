#include "render/integrators/aovs.h"

#include <algorithm>

#include "core/math/geometry.h"
#include "core/surface.h"
#include "render/shading/bsdf.h"

namespace boule {
namespace {

/// x rounded to float; what no float holds becomes the largest float, with the sign of x.
float finite_float(double x) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::clamp(x, -largest, largest));
}

Color at_most_one(const Color& c) {
  return {std::min(c.r, 1.0f), std::min(c.g, 1.0f), std::min(c.b, 1.0f)};
}

/// `met`: the hit as the surface that was met.
Aovs aovs_of(const PreparedScene& scene, const Ray& ray, const Hit& hit, const Hit& met) {
  if (hit.id == no_primitive) return {};
  const Surface surface = find_surface(scene, ray, met);
  const FlatMaterial material = scene.material_of(hit);
  const Scatter weights = scatter(material, surface);
  const Vec3d& p = surface.point;
  const double along = dot(p - scene.camera_view.eye, scene.camera_view.forward);
  return {.depth = finite_float(hit.t * length(vec_cast<double>(ray.dir))),
          .normal = vec_cast<float>(surface.normal),
          .position = {finite_float(p.x), finite_float(p.y), finite_float(p.z)},
          .id = scene.primitive_id(hit),
          .albedo = at_most_one(material.diffuse + weights.reflection + weights.refraction),
          .along = finite_float(along)};
}

}  // namespace

void AovTracer::trace(RayBuffer& rays, Coherence coherence, Aovs* aovs) {
  const std::size_t count = rays.size();
  hits_.resize(count);
  const Query query{solver_, Form::automatic, coherence};
  search_.closest_hit(rays.view(), query, hits_.view());
  const HitStream met = search_.surfaces(hits_.view(), caps_);
  for (std::size_t k = 0; k < count; ++k)
    aovs[k] = aovs_of(scene_, rays.get(k), hits_.get(k), {met.t[k], met.id[k], met.slot[k]});
  primary_ += count;
}

}  // namespace boule
