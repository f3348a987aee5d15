#include "render/integrators/whitted.h"

#include "render/shading/bsdf.h"

namespace boule {

Whitted::Whitted(const PreparedScene& scene, const KernelTable& kernels,
                 const IntegratorSettings& settings)
    : StreamIntegrator(scene, kernels, settings), materials_(scene) {
  scattering_hits_.reserve(StreamSurfaces::block_size);
  for (const Light& light : scene.lights) use_light(light);
}

/// Finds the radiance that needs no shadow rays (background, emission, ambient), and then the rays
/// that go on.
void Whitted::shade(const Block& block) {
  const bool last = ends(block.stream);
  bool any_lit = false;
  scattering_hits_.clear();
  for (auto k = static_cast<std::uint32_t>(block.first); k < block.end; ++k) {
    const Hit met = hit(k);
    if (met.id == no_primitive) {
      radiance_.set(k, seen_background(block.stream, k));
      continue;
    }
    const FlatMaterial& material = materials_.find(met);
    radiance_.set(k, material.constant);
    if (takes_direct_light(material)) {
      illumination_.add_point(k, material);
      any_lit = true;
    }
    if (!last && scatters(material)) scattering_hits_.push_back({k, &material});
  }
  if (!any_lit && scattering_hits_.empty()) return;
  find_surfaces(block);
  for (const ScatteringHit& one : scattering_hits_) {
    spawn_rays(one, surfaces_.get(one.ray - block.first));
  }
}

/// Spawns the reflected ray before the refracted one: the picture's bits depend on this order.
void Whitted::spawn_rays(const ScatteringHit& hit, const Surface& surface) {
  const Scatter weights = scatter(*hit.material, surface);
  if (!is_black(weights.reflection)) {
    spawn(hit.ray, leave(surface, Side::viewer, surface.mirrored), weights.reflection,
          RayKind::reflection);
  }
  if (!is_black(weights.refraction)) {
    spawn(hit.ray, leave(surface, Side::beyond, weights.refracted), weights.refraction,
          RayKind::refraction);
  }
}

void Whitted::spawn(std::size_t parent, const Ray& ray, const Color& weight, RayKind kind) {
  const std::uint64_t before = wavefront_.spawned();
  wavefront_.spawn(parent, ray, weight);
  if (settings_.record != nullptr && wavefront_.spawned() != before)
    settings_.record->expect(kind, weight);
}

}  // namespace boule
