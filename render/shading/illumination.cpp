#include "render/shading/illumination.h"

#include <algorithm>
#include <bit>

#include "render/shading/bsdf.h"
#include "render/shading/lights.h"

namespace boule {

void Illumination::start(std::size_t rays) {
  size_ = rays;
  any_ = false;
  const std::size_t room = std::bit_ceil(rays);
  lit_.resize(room);
  std::fill_n(lit_.data(), padded(rays), std::uint8_t{0});
  shadow_rays_.resize(room);
  to_light_.resize(room);
  cosines_.resize(room);
  rays_.resize(room);
  if (materials_.size() < room) materials_.resize(room);
}

RayStream Illumination::make_shadow_rays(const KernelTable& kernels, const ShadowTarget& light,
                                         StreamSurfaces& surfaces,
                                         const std::optional<Epsilon>& epsilon) {
  RayStream rays = shadow_rays_.view();
  shadow_count_ =
      any_ ? kernels.make_shadow_rays(light, surfaces.lit(lit_.data(), size_),
                                      {rays, to_light_.view(), cosines_.data(), rays_.data()})
           : 0;
  rays.size = shadow_count_;
  if (epsilon) start_by(*epsilon, light);
  return rays;
}

void Illumination::start_by(const Epsilon& epsilon, const ShadowTarget& light) {
  const Vec3d target{light.target[0], light.target[1], light.target[2]};
  for (std::size_t k = 0; k < shadow_count_; ++k) {
    Ray ray = start_by_epsilon(shadow_rays_.get(k), epsilon.points[rays_[k]], epsilon.length);
    if (!light.directional) ray.dir = vec_cast<float>(target - ray.org);
    shadow_rays_.set(k, ray);
  }
}

template <class AnyLight>
void Illumination::add_light(const AnyLight& light, const StreamSurfaces& surfaces,
                             const std::uint8_t* blocked, const ColorStream& radiance) const {
  for (std::size_t k = 0; k < shadow_count_; ++k) {
    if (blocked[k] != 0) continue;
    const std::size_t ray = rays_[k];
    const Color intensity = intensity_at(light, surfaces.point(ray));
    const Color light_sent = direct_light(*materials_[ray], cosines_[k], to_light_.get(k),
                                          surfaces.mirrored(ray), intensity);
    radiance.r[ray] += light_sent.r;
    radiance.g[ray] += light_sent.g;
    radiance.b[ray] += light_sent.b;
  }
}

void Illumination::add_unblocked(const Light& light, const StreamSurfaces& surfaces,
                                 const std::uint8_t* blocked, const ColorStream& radiance) const {
  std::visit([&](const auto& any) { add_light(any, surfaces, blocked, radiance); }, light);
}

}  // namespace boule
