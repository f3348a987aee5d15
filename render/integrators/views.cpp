#include "render/integrators/views.h"

#include <algorithm>

#include "core/math/geometry.h"
#include "core/surface.h"
#include "render/shading/bsdf.h"

namespace boule {
namespace {

/// Rounded to float, the largest one instead of infinity.
float finite_float(double x) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::clamp(x, -largest, largest));
}

Color at_most_one(const Color& c) {
  return {std::min(c.r, 1.0f), std::min(c.g, 1.0f), std::min(c.b, 1.0f)};
}

View view_of(const PreparedScene& scene, const Ray& ray, const Hit& hit) {
  if (hit.id == no_primitive) return {};
  const Surface surface = find_surface(scene, ray, hit);
  const FlatMaterial& material = scene.material_of(hit.id);
  const Scatter way = scatter(material, surface);
  const Vec3d& p = surface.point;
  const auto& eye = scene.camera_view.eye;
  const auto& forward = scene.camera_view.forward;
  const double along =
      dot(p - Vec3d{eye[0], eye[1], eye[2]}, Vec3d{forward[0], forward[1], forward[2]});
  return {finite_float(hit.t * length(vec_cast<double>(ray.dir))),
          vec_cast<float>(surface.normal),
          Vec3f{finite_float(p.x), finite_float(p.y), finite_float(p.z)},
          static_cast<std::uint32_t>(hit.id),
          at_most_one(material.diffuse + way.reflection + way.refraction),
          finite_float(along)};
}

}  // namespace

void Views::trace(RayBuffer& rays, Coherence coherence, View* views) {
  const std::size_t count = rays.size();
  hits_.resize(count);
  const Query query{solver_, Form::automatic, coherence};
  kernels_.closest_hit(geometry_, rays.view(), query, hits_.view());
  for (std::size_t k = 0; k < count; ++k) views[k] = view_of(scene_, rays.get(k), hits_.get(k));
  primary_ += count;
}

}  // namespace boule
