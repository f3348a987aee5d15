#include "render/integrators/whitted.h"

#include <algorithm>

#include "render/shading/background_radiance.h"
#include "render/shading/bsdf.h"

namespace boule {
namespace {

constexpr std::size_t most_rays = StreamSurfaces::block_size;

}  // namespace

Whitted::Whitted(const PreparedScene& scene, const KernelTable& kernels,
                 const IntegratorSettings& settings)
    : StreamIntegrator(scene, kernels, settings, RaysPerDepth::many),
      materials_(scene),
      lobes_(most_rays) {
  scatters_.resize(most_rays);
  for (const Light& light : scene.lights) use_light(light);
  use_seen({seen_background(scene.background), nullptr, 0, 0, HitWeight::none});
}

/// Finds the radiance that needs no shadow rays (background, emission, ambient), and then the rays
/// that go on.
void Whitted::shade(const Block& block) {
  see_light(block);
  const Found found = meet_materials(block);
  if (found.lit || found.scattering) find_surfaces(block);
  if (!found.scattering) return;
  if (settings_.record != nullptr) {
    record_ray(block);
  } else {
    scatter_rays(block);
  }
}

/// Finds the materials that the rays met, and which of them light falls on or send rays on.
Whitted::Found Whitted::meet_materials(const Block& block) {
  const bool last = ends(block.stream);
  Found found;
  std::fill_n(scatters_.data(), padded(block.end - block.first), std::uint8_t{0});
  for (std::size_t k = block.first; k < block.end; ++k) {
    const Hit met = hit(k);
    if (met.id == no_primitive) continue;
    const WhittedMaterial& material = materials_.find(met);
    radiance_.set(k, material.flat.constant);
    if (material.takes_light) {
      illumination_.add_point(k, material.flat);
      found.lit = true;
    }
    if (last || !material.sends_on) continue;
    scatters_[k - block.first] = 1;
    lobes_[k - block.first] = &material.flat;
    recorded_ = &material.flat;
    found.scattering = true;
  }
  return found;
}

void Whitted::scatter_rays(const Block& block) {
  const PathStream& stream = block.stream;
  const PlaneView& planes = surfaces_.planes();
  GoingOn going_on = wavefront_.begin_spawning(most_spawned * (block.end - block.first));
  kernels_.scatter_rays(
      {scatters_.data(), surfaces_.of_block(), lobes_.data(), met_.id + block.first,
       planes.first_id, static_cast<std::uint32_t>(planes.size),
       part(stream.throughput, block.first), stream.sample + block.first, block.end - block.first},
      going_on);
  wavefront_.end_spawning(going_on);
}

/// The same for the only ray of a record, which has the kinds and the weights of its rays as well.
void Whitted::record_ray(const Block& block) {
  const std::size_t ray = block.first;
  const Surface surface = surfaces_.get(0);
  const Scatter weights = scatter(*recorded_, surface);
  if (!is_black(weights.reflection)) {
    spawn(ray, leave(surface, Side::viewer, surface.mirrored), weights.reflection,
          RayKind::reflection);
  }
  if (!is_black(weights.refraction)) {
    spawn(ray, leave(surface, Side::beyond, weights.refracted), weights.refraction,
          RayKind::refraction);
  }
}

void Whitted::spawn(std::size_t parent, const Ray& ray, const Color& weight, RayKind kind) {
  const std::uint64_t before = wavefront_.spawned();
  wavefront_.spawn(parent, ray, weight);
  if (wavefront_.spawned() != before) settings_.record->expect(kind, weight);
}

}  // namespace boule
