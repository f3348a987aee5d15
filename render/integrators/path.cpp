#include "render/integrators/path.h"

#include <algorithm>
#include <bit>

#include "core/math/geometry.h"
#include "core/math/light_cone.h"
#include "core/optics/lobes.h"
#include "render/shading/background_radiance.h"
#include "render/shading/lights.h"

namespace boule {
namespace {

/// The first depth at which Russian roulette may end a path.
constexpr int roulette_depth = 3;

constexpr std::size_t most_points = StreamSurfaces::block_size;

/// The set of random numbers for a use at a depth. The sets of the camera come before them.
RandomSet random_set(int depth, unsigned use) {
  constexpr unsigned uses_per_depth = 3;
  return static_cast<RandomSet>(static_cast<unsigned>(RandomSet::first_bounce) +
                                uses_per_depth * static_cast<unsigned>(depth) + use);
}

HitWeight hit_weight(LightSampling sampling) {
  if (sampling == LightSampling::both) return HitWeight::heuristic;
  return sampling == LightSampling::paths ? HitWeight::full : HitWeight::none;
}

}  // namespace

Path::Path(const PreparedScene& scene, const KernelTable& kernels,
           const IntegratorSettings& settings)
    : StreamIntegrator(scene, kernels, settings, RaysPerDepth::one_at_most),
      keys_(settings.seed),
      environment_share_(!scene.environment.shines() ? 0
                         : scene.area_lights.empty() ? 1
                                                     : 0.5),
      samples_lights_(settings.light_sampling != LightSampling::paths &&
                      (scene.environment.shines() || !scene.area_lights.empty())),
      hit_weight_(hit_weight(settings.light_sampling)),
      materials_(scene),
      matte_(most_points),
      glossy_(most_points),
      clear_(most_points) {
  for (const Light& light : scene.lights) {
    if (std::holds_alternative<SphereLight>(light)) continue;
    use_light(light);
    delta_lights_ = true;
  }
  use_seen({seen_background(scene.background), scene.area_lights.all().data(),
            scene.area_lights.sphere_light_count(), 1 - environment_share_, hit_weight_});
  kinds_.resize(most_points);
  lobes_.resize(most_points);
  for (RandomNumbers* numbers : {&light_numbers_, &bounce_numbers_, &roulette_numbers_})
    numbers->resize(most_points);
  given_light_.resize(most_points);
}

void Path::start(const CameraRays& camera) {
  const std::size_t count = camera.rays.size();
  if (random_keys_.size() < count) random_keys_.resize(std::bit_ceil(count));
  const SampleId* of = nullptr;  // samples of one pixel often follow each other
  std::uint64_t pixel = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const SampleId& id = camera.samples[k];
    if (of == nullptr || id.x != of->x || id.y != of->y) pixel = keys_.of(id.x, id.y);
    of = &id;
    random_keys_[k] = {pixel, static_cast<std::uint32_t>(id.sample)};
  }
}

void Path::make_room(std::size_t rays) {
  materials_.start(rays);
  shadow_buffer_.resize(rays);
  shadows_ = shadow_buffer_.view();
}

/// Each step goes through the whole block, so that its kernels compute W points at a time.
void Path::shade(const Block& block) {
  see_light(block);
  meet_materials(block);
  if (delta_lights_) light_points(block);
  continue_paths(block);
}

/// Finds the materials that the rays met, and adds the light that these emit.
void Path::meet_materials(const Block& block) {
  std::uint32_t* const kinds = kinds_.data();
  const FlatMaterial** const lobes = lobes_.data();
  std::fill_n(kinds, padded(block.end - block.first), std::uint32_t{0});
  for (auto k = static_cast<std::uint32_t>(block.first); k < block.end; ++k) {
    const Hit met = hit(k);
    if (met.id == no_primitive) continue;
    const PathMaterial& material = materials_.find(met);
    kinds[k - block.first] = static_cast<std::uint32_t>(material.kind);
    lobes[k - block.first] = &material.flat;
    if (material.emits) radiance_.add(k, emitted(block.stream, k, met, material.flat.constant));
    if (delta_lights_ && material.takes_light) illumination_.add_point(k, material.flat);
  }
}

/// The light that a ray gets from what it met.
Color Path::emitted(const PathStream& stream, std::uint32_t ray, const Hit& met,
                    const Color& radiance) const {
  const double density{stream.density[ray]};
  const double other = density > 0 ? emitter_density(stream.rays->org(ray), met, radiance) : 0;
  return radiance * static_cast<float>(weight_of_hit(density, other));
}

/// The density with which light sampling at `org` chooses a direction to an emissive primitive; it
/// is the same for all directions that meet it.
double Path::emitter_density(const Vec3d& org, const Hit& hit, const Color& radiance) const {
  if (!scene_.is_sphere(hit)) return 0;
  const Sphere sphere = scene_.geometry.sphere(hit.slot);
  const LightCone cone(org, vec_cast<double>(sphere.center), double{sphere.radius});
  if (scene_.is_cut(sphere)) return 0;
  return (1 - environment_share_) * scene_.area_lights.share_of(sphere, radiance) * cone.density();
}

/// Finds the surfaces on which point and directional lights fall.
void Path::light_points(const Block& block) { find_surfaces(block); }

void Path::continue_paths(const Block& block) {
  const PathStream& stream = block.stream;
  const std::size_t size = block.end - block.first;
  LobePoints matte = matte_.view(), glossy = glossy_.view(), clear = clear_.view();
  kernels_.find_points(
      geometry_,
      {part(stream.rays->view(), block.first, size), part(met_, block.first, size), kinds_.data(),
       part(stream.throughput, block.first), stream.sample + block.first},
      matte, glossy, clear);
  going_on_ = wavefront_.begin_spawning(size);
  const std::size_t first_shadow = shadows_.size;
  continue_points(block, matte, kernels_.continue_matte);
  continue_points(block, glossy, kernels_.continue_glossy);
  if (!ends(stream)) continue_points(block, clear, kernels_.continue_clear);
  wavefront_.end_spawning(going_on_);
  start_shadows_by_epsilon(first_shadow);
}

/// Samples a light for each point, and chooses the direction in which its path goes on.
void Path::continue_points(const Block& block, const LobePoints& points, Continue kernel) {
  if (points.size == 0) return;
  const PathStream& stream = block.stream;
  const bool lit = samples_lights_ && kernel != kernels_.continue_clear;
  const bool last = ends(stream), may_end = stream.depth >= roulette_depth;
  GivenLight given{};
  if (lit) {
    find_numbers(stream, points, Use::light, light_numbers_);
    if (environment_share_ > 0) {
      sample_environment(points);
      given = given_light_.view();
    }
  }
  if (!last) find_numbers(stream, points, Use::bounce, bounce_numbers_);
  if (!last && may_end) find_numbers(stream, points, Use::roulette, roulette_numbers_);
  const PathStep step{.material = lobes_.data(),
                      .first_ray = static_cast<std::uint32_t>(block.first),
                      .samples_lights = lit,
                      .goes_on = !last,
                      .weighs = !last && settings_.light_sampling != LightSampling::lights,
                      .lights = scene_.area_lights.all().data(),
                      .light_count = scene_.area_lights.all().size(),
                      .environment_share = environment_share_,
                      .light = light_numbers_.view(),
                      .bounce = bounce_numbers_.view(),
                      .survival = may_end ? roulette_numbers_.view().u : nullptr,
                      .given = given};
  kernel(points, step, shadows_, going_on_);
}

/// Samples the environment for the points whose numbers pick it, and none of the spheres.
void Path::sample_environment(const LobePoints& points) {
  for (std::size_t i = 0; i < points.size; ++i) {
    UnitPair numbers = light_numbers_.get(i);
    if (!(numbers.u < environment_share_)) {
      given_light_.set_none(i);
      continue;
    }
    numbers.u /= environment_share_;
    const auto [to_light, density] = scene_.environment.sample(numbers);
    given_light_.set(i, to_light, environment_share_ * density,
                     background_radiance(scene_.background, vec_cast<float>(to_light)));
  }
}

/// If asked, shadow rays to sampled lights start as the lecture's do, from number `first` on.
void Path::start_shadows_by_epsilon(std::size_t first) {
  const auto epsilon = this->epsilon();
  if (!epsilon) return;
  for (std::size_t k = first; k < shadows_.size; ++k) {
    const Vec3f& point = epsilon->points[shadows_.ray[k]];
    shadow_buffer_.set_shadow_ray(
        k, start_by_epsilon(shadow_buffer_.shadow_ray(k), point, epsilon->length));
  }
}

/// Finds the random numbers of all points for this use.
void Path::find_numbers(const PathStream& stream, const LobePoints& points, Use use,
                        RandomNumbers& numbers) {
  const RandomSet set = random_set(stream.depth, static_cast<unsigned>(use));
  numbers.ask_all(points.size, set, [&](std::size_t i) { return random_keys_[points.sample[i]]; });
  numbers.find(kernels_, points.size);
}

void Path::add_more_light() {
  if (shadows_.size == 0) return;
  RayStream rays = shadows_.rays;
  rays.size = shadows_.size;
  const std::uint8_t* blocked = find_blocked(rays, Coherence::none);
  const ColorStream sum = radiance_.view(), light = shadows_.radiance;
  const std::uint32_t* const ray = shadows_.ray;
  // Black is added where light is blocked: a branch would often go the way that was not foreseen.
  for (std::size_t k = 0; k < shadows_.size; ++k) {
    const bool arrives = blocked[k] == 0;
    sum.r[ray[k]] += arrives ? light.r[k] : 0;
    sum.g[ray[k]] += arrives ? light.g[k] : 0;
    sum.b[ray[k]] += arrives ? light.b[k] : 0;
  }
}

/// Weighted if light sampling could have found it too.
Color Path::see_image(const PathStream& stream, std::size_t ray) const {
  const Color radiance = StreamIntegrator::see_image(stream, ray);
  const double density{stream.density[ray]};
  if (!(environment_share_ > 0) || !(density > 0)) return radiance;
  const double other =
      scene_.environment.density(normalize(vec_cast<double>(stream.rays->dir(ray))));
  return radiance * static_cast<float>(weight_of_hit(density, environment_share_ * other));
}

/// The weight of light that a path found by its direction, which was chosen with `density` (0: by
/// the camera or a mirror). Light sampling would have chosen it with `light_density`.
double Path::weight_of_hit(double density, double light_density) const {
  if (!(density > 0) || !(light_density > 0) || hit_weight_ == HitWeight::full) return 1;
  return hit_weight_ == HitWeight::none ? 0 : power_heuristic(density, light_density);
}

}  // namespace boule
