#include "render/integrators/whitted.h"

#include "render/shading/background.h"
#include "render/shading/bsdf.h"

namespace boule {

Whitted::Whitted(const PreparedScene& scene, const KernelTable& kernels,
                 const IntegratorSettings& settings)
    : scene_(scene),
      kernels_(kernels),
      settings_(settings),
      geometry_(scene.geometry.view()),
      wavefront_(settings.stream_size) {}

bool Whitted::trace(RayBuffer& rays, Coherence coherence, Color* radiance) {
  primary_ += rays.size();
  wavefront_.start(rays);
  while (const PathStream* stream = wavefront_.next()) {
    if (cancelled()) return false;
    shade(*stream, stream->depth == 0 ? coherence : Coherence::none);
  }
  wavefront_.finish(radiance);
  return true;
}

bool Whitted::cancelled() const {
  return settings_.cancel != nullptr && settings_.cancel->load(std::memory_order_relaxed);
}

void Whitted::shade(const PathStream& stream, Coherence coherence) {
  find_points(stream, coherence);
  for (const Light& light : scene_.lights) add_light(light);
  for (std::size_t k = 0; k < stream.rays->size(); ++k) wavefront_.add(k, radiance_[k]);
  if (stream.depth == settings_.max_depth) return;
  for (const Point& point : points_) {
    if (scatters(*point.material)) continue_from(point);
  }
}

/// Finds what each ray hits, and the radiance that needs no light: background, emission, ambient.
void Whitted::find_points(const PathStream& stream, Coherence coherence) {
  const std::size_t count = stream.rays->size();
  hits_.resize(count);
  const Query query{settings_.solver, Form::automatic, coherence};
  kernels_.closest_hit(geometry_, stream.rays->view(), query, hits_.view());
  points_.clear();
  radiance_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Hit hit = hits_.get(k);
    const Ray ray = stream.rays->get(k);
    if (hit.id == no_primitive) {
      radiance_[k] = background_radiance(scene_.background, ray.dir);
      continue;
    }
    const FlatMaterial& material = scene_.material_of(hit.id);
    radiance_[k] = material.constant;
    points_.push_back({static_cast<std::uint32_t>(k), &material, find_surface(scene_, ray, hit)});
  }
}

/// Adds one light to the radiance of the points it reaches: one stream of shadow rays.
void Whitted::add_light(const Light& light) {
  shadow_rays_.resize(points_.size());
  arrivals_.clear();
  for (const Point& point : points_) {
    if (!takes_direct_light(*point.material)) continue;
    const LightSample sample = sample_light(light, point.surface.point);
    if (!faces(point.surface, sample.to_light)) continue;
    shadow_rays_.set(arrivals_.size(), shadow_ray(light, point.surface));
    arrivals_.push_back({&point, sample});
  }
  if (arrivals_.empty()) return;
  shadow_rays_.resize(arrivals_.size());
  occluded_.resize(arrivals_.size());
  shadow_ += arrivals_.size();
  const Query query{settings_.solver, Form::automatic, shadow_coherence(light)};
  kernels_.any_hit(geometry_, shadow_rays_.view(), query, occluded_.data());
  for (std::size_t k = 0; k < arrivals_.size(); ++k) {
    if (occluded_[k] != 0) continue;
    const auto& [point, arriving] = arrivals_[k];
    Color& radiance = radiance_[point->ray];
    radiance = radiance + direct_light(*point->material, point->surface, arriving.to_light,
                                       arriving.intensity);
  }
}

/// Reflection before refraction: the order is part of the picture's bits.
void Whitted::continue_from(const Point& point) {
  const Surface& surface = point.surface;
  const Scatter way = scatter(*point.material, surface);
  if (!is_black(way.reflection)) {
    wavefront_.spawn(point.ray, leave(surface, Side::viewer, surface.mirrored), way.reflection);
  }
  if (!is_black(way.refraction)) {
    wavefront_.spawn(point.ray, leave(surface, Side::beyond, way.refracted), way.refraction);
  }
}

}  // namespace boule
