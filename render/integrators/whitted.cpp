#include "render/integrators/whitted.h"

#include <bit>

#include "render/shading/background.h"
#include "render/shading/bsdf.h"
#include "render/shading/lights.h"

namespace boule {

Whitted::Whitted(const PreparedScene& scene, const KernelTable& kernels,
                 const IntegratorSettings& settings)
    : scene_(scene),
      kernels_(kernels),
      settings_(settings),
      geometry_(scene.geometry.view()),
      wavefront_(settings.stream_size) {}

bool Whitted::trace(const CameraRays& camera, Color* radiance) {
  primary_ += camera.rays.size();
  wavefront_.start(camera.rays);
  while (const PathStream* stream = wavefront_.next()) {
    if (cancelled()) return false;
    shade(*stream, stream->depth == 0 ? camera.coherence : Coherence::none);
  }
  wavefront_.finish(radiance);
  return true;
}

bool Whitted::cancelled() const {
  return settings_.cancel != nullptr && settings_.cancel->load(std::memory_order_relaxed);
}

void Whitted::shade(const PathStream& stream, Coherence coherence) {
  make_room(stream.rays->size());
  find_points(stream, coherence);
  for (const Light& light : scene_.lights) add_light(light);
  for (std::size_t k = 0; k < stream.rays->size(); ++k) wavefront_.add(k, radiance_[k]);
  for (const Point& point : points_) continue_from(point);
}

/// Makes room for what comes of so many rays. By powers of two: as blocks fill up one more than the
/// other, memory must not be taken for each.
void Whitted::make_room(std::size_t rays) {
  const std::size_t room = std::bit_ceil(rays);
  hits_.resize(room);
  occluded_.resize(room);
  points_.reserve(room);
  if (radiance_.size() < room) radiance_.resize(room);
  illumination_.start(rays);
}

/// Finds what each ray hits, and the radiance that needs no light: background, emission, ambient.
void Whitted::find_points(const PathStream& stream, Coherence coherence) {
  const std::size_t count = stream.rays->size();
  const bool last = stream.depth == settings_.max_depth;
  hits_.resize(count);
  const Query query{settings_.solver, Form::automatic, coherence};
  kernels_.closest_hit(geometry_, stream.rays->view(), query, hits_.view());
  points_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const Hit hit = hits_.get(k);
    const Ray ray = stream.rays->get(k);
    if (hit.id == no_primitive) {
      radiance_[k] = background_radiance(scene_.background, ray.dir);
      continue;
    }
    const FlatMaterial& material = scene_.material_of(hit.id);
    radiance_[k] = material.constant;
    const bool lit = takes_direct_light(material), goes_on = !last && scatters(material);
    if (!lit && !goes_on) continue;
    const Surface surface = find_surface(scene_, ray, hit);
    const auto index = static_cast<std::uint32_t>(k);
    if (lit) illumination_.add_point(index, material, surface);
    if (goes_on) points_.push_back({index, &material, surface});
  }
}

/// Adds one light to the radiance of the points it reaches: one stream of shadow rays.
void Whitted::add_light(const Light& light) {
  const RayStream rays = illumination_.aim(light);
  if (rays.size == 0) return;
  shadow_ += rays.size;
  const Query query{settings_.solver, Form::automatic, shadow_coherence(light)};
  kernels_.any_hit(geometry_, rays, query, occluded_.data());
  illumination_.add_unblocked(light, occluded_.data(), radiance_.data());
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
