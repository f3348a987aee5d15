#include "render/shading/illumination.h"

#include <algorithm>
#include <bit>

namespace boule {

void Illumination::start(std::size_t rays) {
  const std::size_t room = std::bit_ceil(rays);
  lit_.resize(room);
  std::fill_n(lit_.data(), padded(rays), std::uint8_t{0});
  shadow_rays_.resize(room);
  to_light_.resize(room);
  cosines_.resize(room);
  rays_.resize(room);
  if (materials_.size() < room) materials_.resize(room);
  size_ = rays;
  any_ = false;
  shadow_count_ = 0;
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

void Illumination::add_unblocked(const KernelTable& kernels, const LightIntensity& light,
                                 StreamSurfaces& surfaces, const std::uint8_t* blocked,
                                 const ColorStream& radiance) {
  kernels.add_direct_light(light,
                           {blocked, to_light_.view(), cosines_.data(), rays_.data(), shadow_count_,
                            surfaces.points(), surfaces.mirrored(), materials_.data()},
                           radiance);
}

}  // namespace boule
