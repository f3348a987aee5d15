#include "render/integrators/stream_integrator.h"

#include <algorithm>
#include <bit>

#include "render/integrators/ray_record.h"
#include "render/shading/background_radiance.h"
#include "render/shading/lights.h"

namespace boule {

namespace {

/// The weight that may be left out at each depth.
float weight_of_depth(const IntegratorSettings& settings) {
  return settings.least_weight / static_cast<float>(std::max(settings.max_depth, 1));
}

}  // namespace

StreamIntegrator::StreamIntegrator(const PreparedScene& scene, const KernelTable& kernels,
                                   const IntegratorSettings& settings, RaysPerDepth rays)
    : scene_(scene),
      kernels_(kernels),
      settings_(settings),
      wavefront_(kernels, settings.stream_size, most_spawned * StreamSurfaces::block_size, rays,
                 rays == RaysPerDepth::many ? weight_of_depth(settings) : 0),
      surfaces_(scene, kernels),
      geometry_(scene.geometry.view()),
      search_(scene, kernels) {
  if (scene.ghosts && settings.record == nullptr) ghosts_.emplace(scene, kernels);
}

void StreamIntegrator::use_light(const Light& light) {
  lights_.push_back({&light, shadow_target(light), light_intensity(light)});
}

void StreamIntegrator::use_seen(const SeenLight& seen) {
  seen_ = seen_by_camera_ = seen;
  if (scene_.backdrop)
    seen_by_camera_.background = seen_background(ConstantBackground{*scene_.backdrop});
}

bool StreamIntegrator::trace(const CameraRays& camera, Color* radiance) {
  primary_ += camera.rays.size();
  start(camera);
  wavefront_.start(camera.rays);
  while (const PathStream* stream = wavefront_.next()) {
    if (cancelled()) return false;
    trace_stream(*stream, camera);
  }
  wavefront_.finish(radiance);
  if (settings_.fog.strength > 0) add_fog(radiance);
  if (ghosts_) ghosts_->add(radiance);
  return true;
}

bool StreamIntegrator::cancelled() const {
  return settings_.cancel != nullptr && settings_.cancel->load(std::memory_order_relaxed);
}

/// Makes room by powers of two. The streams grow from block to block, and memory must not be
/// allocated for each of them.
void StreamIntegrator::trace_stream(const PathStream& stream, const CameraRays& camera) {
  const std::size_t count = stream.rays->size(), room = std::bit_ceil(count);
  hits_.resize(room);
  radiance_.resize(room);
  surfaces_.resize(room);
  illumination_.start(count);
  make_room(room);
  hits_.resize(count);
  depth_ = stream.depth;
  const bool first_hits = depth_ == 0;
  const Query query{settings_.solver, Form::automatic,
                    first_hits ? camera.coherence : Coherence::none, &experience().nearest};
  search_.closest_hit(stream.rays->view(), query, hits_.view());
  met_ = search_.surfaces(hits_.view(), caps_);
  if (settings_.shadow_epsilon) find_float_points(stream);
  if (settings_.record != nullptr)
    settings_.record->begin(
        stream.rays->get(0), hit(0), {met_.t[0], met_.id[0], met_.slot[0]},
        {stream.throughput.r[0], stream.throughput.g[0], stream.throughput.b[0]});
  if (first_hits && settings_.fog.strength > 0) find_fog(stream);
  if (first_hits && ghosts_) ghosts_->find(stream.rays->view(), query, hits_.view(), settings_.fog);
  if (first_hits && camera.covered != nullptr) tell_coverage(camera.covered);
  for (std::size_t first = 0; first < count; first += StreamSurfaces::block_size) {
    shade({stream, first, std::min(first + StreamSurfaces::block_size, count)});
  }
  for (const TargetedLight& light : lights_) add_light(light);
  add_more_light();
  if (settings_.record != nullptr) settings_.record->finish(radiance_.get(0));
  wavefront_.add(radiance_.view());
}

StreamIntegrator::DepthExperience& StreamIntegrator::experience() {
  return experience_[std::min(static_cast<std::size_t>(depth_), experience_.size() - 1)];
}

/// The points of the stream's hits as floats have them, for shadow rays that start by an epsilon.
void StreamIntegrator::find_float_points(const PathStream& stream) {
  if (float_points_.size() < hits_.size()) float_points_.resize(hits_.size());
  for (std::size_t k = 0; k < hits_.size(); ++k)
    float_points_[k] = float_point(stream.rays->get(k), hit(k));
}

std::optional<Illumination::Epsilon> StreamIntegrator::epsilon() const {
  if (!settings_.shadow_epsilon) return std::nullopt;
  return Illumination::Epsilon{*settings_.shadow_epsilon, float_points_.data()};
}

/// The fog in front of the hits of the camera's rays, in the colour that is seen where they miss.
void StreamIntegrator::find_fog(const PathStream& stream) {
  veils_.assign(hits_.size(), {});
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    const Hit met = hit(k);
    if (met.id == no_primitive) continue;
    const Ray ray = stream.rays->get(k);
    const Vec3d point = ray.org + vec_cast<double>(ray.dir) * met.t;
    Veil& veil = veils_[k];
    veil.share = settings_.fog.share(depth_of(scene_.camera_view, point));
    if (veil.share > 0) veil.color = seen_behind(scene_.background, scene_.backdrop, ray.dir);
  }
}

void StreamIntegrator::add_fog(Color* radiance) const {
  for (std::size_t k = 0; k < veils_.size(); ++k) {
    const auto& [share, color] = veils_[k];
    if (share > 0) radiance[k] = radiance[k] * (1 - share) + color * share;
  }
}

void StreamIntegrator::tell_coverage(std::uint8_t* covered) const {
  const bool has_fog = settings_.fog.strength > 0;
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    float seen = hit(k).id == no_primitive ? 0 : has_fog ? 1 - veils_[k].share : 1;
    if (ghosts_) seen = ghosts_->coverage(k, seen);
    covered[k] = static_cast<std::uint8_t>(seen * float{whole_coverage} + 0.5F);
  }
}

void StreamIntegrator::see_light(const Block& block) {
  const PathStream& stream = block.stream;
  const std::size_t size = block.end - block.first;
  const SeenLight& seen = stream.depth == 0 ? seen_by_camera_ : seen_;
  kernels_.see_light(
      seen, {part(stream.rays->view(), block.first, size), part(hits_.view(), block.first, size),
             stream.density + block.first, part(radiance_.view(), block.first)});
  if (seen.background.kind != SeenBackground::Kind::other) return;
  for (std::size_t k = block.first; k < block.end; ++k) {
    if (hit(k).id == no_primitive) radiance_.add(k, see_image(stream, k));
  }
}

Color StreamIntegrator::see_image(const PathStream& stream, std::size_t ray) const {
  return background_radiance(scene_.background, stream.rays->dir(ray));
}

void StreamIntegrator::find_surfaces(const Block& block) {
  surfaces_.find(block.stream.rays->view(), met_, block.first, block.end - block.first);
}

/// Adds the direct light of one light, which takes one stream of shadow rays.
void StreamIntegrator::add_light(const TargetedLight& light) {
  const RayStream rays =
      illumination_.make_shadow_rays(kernels_, light.target, surfaces_, epsilon());
  if (rays.size == 0) return;
  const std::uint8_t* blocked = find_blocked(rays, shadow_coherence(*light.light));
  illumination_.add_unblocked(kernels_, light.intensity, surfaces_, blocked, radiance_.view());
  if (settings_.record != nullptr) record_shadow(light, rays, blocked);
}

/// The only shadow ray, with what blocks it, and what arrives along it.
void StreamIntegrator::record_shadow(const TargetedLight& light, const RayStream& rays,
                                     const std::uint8_t* blocked) {
  const Query query{settings_.solver, Form::automatic, Coherence::none};
  HitBuffer met(1);
  if (blocked[0] != 0) search_.closest_hit(rays, query, met.view());
  Color arriving;
  illumination_.add_unblocked(kernels_, light.intensity, surfaces_, blocked,
                              {&arriving.r, &arriving.g, &arriving.b});
  const auto index = static_cast<std::size_t>(light.light - scene_.lights.data());
  settings_.record->add_shadow(index, illumination_.shadow_ray(0),
                               blocked[0] != 0 ? met.get(0) : Hit{}, arriving);
}

const std::uint8_t* StreamIntegrator::find_blocked(const RayStream& shadow_rays,
                                                   Coherence coherence) {
  shadow_ += shadow_rays.size;
  blocked_.resize(std::bit_ceil(shadow_rays.size));
  // By an epsilon each of them has an origin and an end of its own.
  const Query query{settings_.solver, Form::automatic,
                    settings_.shadow_epsilon ? Coherence::none : coherence, &experience().shadow};
  search_.any_hit(shadow_rays, query, blocked_.data());
  return blocked_.data();
}

}  // namespace boule
