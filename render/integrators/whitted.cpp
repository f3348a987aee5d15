#include "render/integrators/whitted.h"

#include "render/shading/background.h"
#include "render/shading/bsdf.h"

namespace boule {

Whitted::Whitted(const PreparedScene& scene, const KernelTable& kernels,
                 const IntegratorSettings& settings)
    : StreamIntegrator(scene, kernels, settings) {
  for (const Light& light : scene.lights) use_light(light);
  points_.reserve(Surfaces::block_size);
}

/// The radiance that needs no light: background, emission, ambient; then the rays that go on.
void Whitted::shade(const Block& block) {
  const bool last = ends(block.stream);
  bool any_lit = false;
  points_.clear();
  for (std::size_t k = block.first; k < block.end; ++k) {
    const std::int32_t id = hit(k).id;
    if (id == no_primitive) {
      radiance(k) = background_radiance(scene_.background, block.stream.rays->dir(k));
      continue;
    }
    const FlatMaterial& material = scene_.material_of(id);
    radiance(k) = material.constant;
    if (takes_direct_light(material)) {
      illumination_.add_point(k, material);
      any_lit = true;
    }
    if (!last && scatters(material)) points_.push_back({k, &material});
  }
  if (!any_lit && points_.empty()) return;
  find_surfaces(block);
  for (const auto& [ray, material] : points_) {
    go_on(ray, *material, surfaces_.get(ray - block.first));
  }
}

/// Reflection before refraction: the order is part of the picture's bits.
void Whitted::go_on(std::size_t ray, const FlatMaterial& material, const Surface& surface) {
  const Scatter way = scatter(material, surface);
  if (!is_black(way.reflection)) {
    wavefront_.spawn(ray, leave(surface, Side::viewer, surface.mirrored), way.reflection);
  }
  if (!is_black(way.refraction)) {
    wavefront_.spawn(ray, leave(surface, Side::beyond, way.refracted), way.refraction);
  }
}

}  // namespace boule
