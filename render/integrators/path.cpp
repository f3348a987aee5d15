#include "render/integrators/path.h"

#include <algorithm>
#include <bit>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "render/shading/background_radiance.h"
#include "render/shading/lights.h"

namespace boule {
namespace {

/// The first depth at which Russian roulette may end a path.
constexpr int roulette_depth = 3;
/// The largest probability to survive it: in a scene that absorbs nothing, paths must end as well.
constexpr float largest_survival = 0.95f;

/// The set of random numbers for a use at a depth. The sets of the camera come before them.
RandomSet random_set(int depth, unsigned use) {
  constexpr unsigned uses_per_depth = 3;
  return static_cast<RandomSet>(static_cast<unsigned>(RandomSet::first_bounce) +
                                uses_per_depth * static_cast<unsigned>(depth) + use);
}

/// a b scale, in double: a product of two of them could overflow or underflow in float.
Color multiply(const Color& a, const Color& b, double scale) {
  const auto product = [scale](float x, float y) {
    return static_cast<float>(double{x} * double{y} * scale);
  };
  return {product(a.r, b.r), product(a.g, b.g), product(a.b, b.b)};
}

/// False only if a line along `dir` certainly misses the sphere; takes no root and no quotient.
/// Compares the line's distance from the centre with twice the radius, plus a little for rounding.
bool may_meet(const Vec3d& dir, const Vec3d& to_center, double radius) {
  const Vec3d aside = cross(dir, to_center);
  return !(dot(aside, aside) >
           dot(dir, dir) * (4 * radius * radius + 1e-29 * dot(to_center, to_center)));
}

/// Veach's power heuristic with exponent 2: the weight of a sample with density a, where the other
/// way would have chosen it with density b.
double power_heuristic(double a, double b) {
  const double ratio = b / a;
  return 1 / (1 + ratio * ratio);
}

}  // namespace

Path::Path(const PreparedScene& scene, const KernelTable& kernels,
           const IntegratorSettings& settings)
    : StreamIntegrator(scene, kernels, settings),
      keys_(settings.seed),
      environment_share_(!scene.environment.shines() ? 0
                         : scene.area_lights.empty() ? 1
                                                     : 0.5),
      samples_lights_(settings.light_sampling != LightSampling::paths &&
                      (scene.environment.shines() || !scene.area_lights.empty())) {
  for (const Light& light : scene.lights) {
    if (std::holds_alternative<SphereLight>(light)) continue;
    use_light(light);
    delta_lights_ = true;
  }
  constexpr std::size_t most = StreamSurfaces::block_size;
  points_.reserve(most);
  picked_lights_.reserve(most);
  choices_.resize(most);
  numbers_.resize(most);
  light_cones_.resize(most);
  directions_.resize(most);
}

void Path::start(const CameraRays& camera) {
  const std::size_t count = camera.rays.size();
  if (random_keys_.size() < count) random_keys_.resize(std::bit_ceil(count));
  for (std::size_t k = 0; k < count; ++k) {
    const SampleId& id = camera.samples[k];
    random_keys_[k] = {keys_.of(id.x, id.y), static_cast<std::uint32_t>(id.sample)};
  }
}

void Path::make_room(std::size_t rays) {
  shadow_rays_.resize(rays);
  sampled_lights_.clear();
  sampled_lights_.reserve(rays);
}

/// Each step goes through the whole block, so that its kernels compute W points at a time.
void Path::shade(const Block& block) {
  scattering_hits_.clear();
  points_.clear();
  for (auto k = static_cast<std::uint32_t>(block.first); k < block.end; ++k) {
    if (const FlatMaterial* material = find_emission(block.stream, k))
      scattering_hits_.push_back({k, material});
  }
  if (scattering_hits_.empty()) return;
  find_surfaces(block);
  for (const ScatteringHit& one : scattering_hits_) {
    add_point(one, surfaces_.get(one.ray - block.first));
  }
  if (samples_lights_) sample_lights(block.stream);
  if (!ends(block.stream)) continue_paths(block.stream);
}

/// Sets the radiance that a ray finds by its direction: of its hit, of lights that it crosses, of
/// the background. Returns the material of the hit if that sends light on, else null.
const FlatMaterial* Path::find_emission(const PathStream& stream, std::uint32_t index) {
  const Hit met = hit(index);
  const double density = stream.density[index];
  Color& sum = radiance(index);
  sum = density > 0 ? crossed_lights(stream.rays->get(index), density, met.t) : Color{};
  if (met.id == no_primitive) {
    sum = sum + weighted_background(stream, index);
    return nullptr;
  }
  const FlatMaterial& material = materials_.find(met);
  if (is_black(material.constant)) {
    return takes_direct_light(material) || scatters(material) ? &material : nullptr;
  }
  // Only emissive materials have a constant, and they send nothing on.
  const double other =
      density > 0 ? emitter_density(stream.rays->org(index), met, material.constant) : 0;
  sum = sum + material.constant * static_cast<float>(weight_of_hit(density, other));
  return nullptr;
}

/// The density with which light sampling at `org` chooses a direction to an emissive primitive; it
/// is the same for all directions that meet it.
double Path::emitter_density(const Vec3d& org, const Hit& hit, const Color& radiance) const {
  if (!scene_.is_sphere(hit)) return 0;
  const AreaLight light = scene_.area_lights.light_of(scene_.geometry.sphere(hit.slot), radiance);
  return (1 - environment_share_) * light.share *
         LightCone(org, light.center, light.radius).density();
}

void Path::add_point(const ScatteringHit& hit, const Surface& surface) {
  const Point& point = points_.emplace_back(hit.ray, *hit.material, surface);
  if (point.lobes.black()) {
    points_.pop_back();
  } else if (point.lit && delta_lights_) {
    illumination_.add_point(hit.ray, *hit.material);
  }
}

/// Picks a light for each point, the environment or one of the spheres, and a direction to it.
void Path::sample_lights(const PathStream& stream) {
  find_numbers(stream, Use::light);
  picked_lights_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    if (!point.lit) continue;
    UnitPair numbers = numbers_.get(i);
    if (sample_environment(stream, point, numbers)) continue;
    const AreaLight& light = scene_.area_lights.pick(numbers.u);
    light_cones_.set(picked_lights_.size(), surfaces_.departure(point.ray).org, light.center,
                     light.radius, numbers.u, numbers.v);
    picked_lights_.push_back({&point, &light});
  }
  sample_spheres(stream);
}

/// Samples the environment if the numbers pick it. Else returns false, and the numbers become new
/// ones for the spheres.
bool Path::sample_environment(const PathStream& stream, const Point& point, UnitPair& numbers) {
  if (!(numbers.u < environment_share_)) {
    numbers.u = (numbers.u - environment_share_) / (1 - environment_share_);
    return false;
  }
  numbers.u /= environment_share_;
  const auto [to_light, density] = scene_.environment.sample(numbers);
  const Departure departure = surfaces_.departure(point.ray);
  const Ray ray{departure.org, vec_cast<float>(to_light)};
  const Color radiance = background_radiance(scene_.background, ray.dir);
  add_shadow_ray(stream, point, from_surface(ray, departure),
                 {to_light, environment_share_ * density, radiance});
  return true;
}

void Path::sample_spheres(const PathStream& stream) {
  kernels_.sample_cones(light_cones_.view(picked_lights_.size()));
  const double sphere_share = 1 - environment_share_;
  for (std::size_t i = 0; i < picked_lights_.size(); ++i) {
    const auto& [point, light] = picked_lights_[i];
    const Departure departure = surfaces_.departure(point->ray);
    const Vec3d direction = light_cones_.direction(i);
    Ray ray{departure.org, vec_cast<float>(direction)};
    ray.tmax = light_cones_.tmax(i);
    add_shadow_ray(
        stream, *point, from_surface(ray, departure),
        {direction, sphere_share * light->share * light_cones_.density(i), light->radiance});
  }
}

/// Adds the shadow ray that decides whether a sampled light arrives, unless its weight is 0.
void Path::add_shadow_ray(const PathStream& stream, const Point& point, const Ray& ray,
                          const LightSample& light) {
  const double cosine = dot(point.surface.normal, light.direction);
  if (!(cosine > 0) || !(light.density > 0)) return;
  const double density = point.lobes.density(cosine, light.direction);
  const double weight = weight_of_light(light.density, density, ends(stream));
  const Color reflected = point.lobes.reflected(cosine, light.direction);
  const auto epsilon = this->epsilon();
  shadow_rays_.set(
      sampled_lights_.size(),
      epsilon ? start_by_epsilon(ray, epsilon->points[point.ray], epsilon->length) : ray);
  sampled_lights_.push_back(
      {point.ray, multiply(reflected, light.radiance, weight / (elementary::pi * light.density))});
}

/// Spawns the rays with which paths go on, unless the roulette ends them.
void Path::continue_paths(const PathStream& stream) {
  choose_directions(stream);
  const bool may_end = stream.depth >= roulette_depth;
  if (may_end) find_numbers(stream, Use::roulette);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    Bounce bounce = point.lobes.bounce(choices_[i], directions_.direction(i));
    if (is_black(bounce.weight)) continue;
    if (may_end && !survives(stream, point, numbers_.get(i), bounce)) continue;
    wavefront_.spawn(point.ray, leave(point.surface, bounce.side, bounce.direction), bounce.weight,
                     static_cast<float>(bounce.density));
  }
}

/// Chooses a lobe for each point, and a direction in it if the lobe has more than one.
void Path::choose_directions(const PathStream& stream) {
  find_numbers(stream, Use::bounce);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const LobeSampler& lobes = points_[i].lobes;
    const LobeSampler::Choice& choice = choices_[i] = lobes.choose(numbers_.get(i));
    directions_.set(i, lobes.axis(choice), choice.from.cosine, choice.from.sine, choice.turns);
  }
  kernels_.to_world(directions_.view(points_.size()));
}

/// Russian roulette: a path survives with some probability, by which its weight is divided.
bool Path::survives(const PathStream& stream, const Point& point, UnitPair numbers,
                    Bounce& bounce) {
  const Color left = stream.throughput[point.ray] * bounce.weight;
  const float survival = std::min(std::max({left.r, left.g, left.b}), largest_survival);
  if (!(numbers.u < static_cast<double>(survival))) return false;
  bounce.weight = bounce.weight * (1 / survival);
  return true;
}

/// Finds the random numbers of all points for this use.
void Path::find_numbers(const PathStream& stream, Use use) {
  const RandomSet set = random_set(stream.depth, static_cast<unsigned>(use));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const RandomKey& key = random_keys_[stream.sample[points_[i].ray]];
    numbers_.ask(i, key.pixel, set, key.sample);
  }
  numbers_.find(kernels_, points_.size());
}

void Path::add_more_light() {
  if (sampled_lights_.empty()) return;
  RayStream rays = shadow_rays_.view();
  rays.size = sampled_lights_.size();
  const std::uint8_t* blocked = find_blocked(rays, Coherence::none);
  for (std::size_t k = 0; k < sampled_lights_.size(); ++k) {
    if (blocked[k] != 0) continue;
    Color& sum = radiance(sampled_lights_[k].ray);
    sum = sum + sampled_lights_[k].radiance;
  }
}

/// The background that a ray sees, weighted if light sampling could have found it too.
Color Path::weighted_background(const PathStream& stream, std::uint32_t ray) const {
  const Color radiance = seen_background(stream, ray);
  const double density{stream.density[ray]};
  if (!(environment_share_ > 0) || !(density > 0)) return radiance;
  const double other =
      scene_.environment.density(normalize(vec_cast<double>(stream.rays->dir(ray))));
  return radiance * static_cast<float>(weight_of_hit(density, environment_share_ * other));
}

/// The radiance of the sphere lights that a ray crosses before t. They are not objects, so the ray
/// does not end there. Only rays from a diffuse lobe or a highlight see them, with the ray's
/// density.
Color Path::crossed_lights(const Ray& ray, double density, double t) const {
  Color sum;
  const AreaLights& lights = scene_.area_lights;
  if (lights.sphere_light_count() == 0) return sum;
  const Vec3d dir = vec_cast<double>(ray.dir);
  const double size = length(dir);
  for (std::size_t i = 0; i < lights.sphere_light_count(); ++i) {
    const AreaLight& light = lights.sphere_lights()[i];
    if (!may_meet(dir, light.center - ray.org, light.radius)) continue;
    const LightCone cone(ray.org, light.center, light.radius);
    if (!cone.meets(dir * (1 / size), t * size)) continue;
    const double weight =
        weight_of_hit(density, (1 - environment_share_) * light.share * cone.density());
    sum = sum + light.radiance * static_cast<float>(weight);
  }
  return sum;
}

/// The weight of light that a path found by its direction, which was chosen with `density` (0: by
/// the camera or a mirror). Light sampling would have chosen it with `light_density`.
double Path::weight_of_hit(double density, double light_density) const {
  if (!(density > 0) || !(light_density > 0)) return 1;
  if (settings_.light_sampling == LightSampling::both)
    return power_heuristic(density, light_density);
  return settings_.light_sampling == LightSampling::paths ? 1 : 0;
}

/// The weight of light that was sampled with `light_density`. The path itself would have gone there
/// with `density`; `last`: it does not go on.
double Path::weight_of_light(double light_density, double density, bool last) const {
  if (last || settings_.light_sampling == LightSampling::lights) return 1;
  return power_heuristic(light_density, density);
}

}  // namespace boule
