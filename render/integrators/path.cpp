#include "render/integrators/path.h"

#include <algorithm>
#include <bit>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "render/shading/background_radiance.h"
#include "render/shading/lights.h"

namespace boule {
namespace {

/// The first depth at which a path may end by chance, and how likely it goes on at most: a scene
/// that absorbs nothing must not keep it for ever.
constexpr int roulette_depth = 3;
constexpr float most_likely = 0.95f;

/// The set of a number's use at a depth; the camera's sets come before all of them.
RandomSet random_set(int depth, unsigned use) {
  constexpr unsigned uses_per_depth = 3;
  return static_cast<RandomSet>(static_cast<unsigned>(RandomSet::first_bounce) +
                                uses_per_depth * static_cast<unsigned>(depth) + use);
}

/// a b scale: neither may overflow, or be lost, before they come together.
Color multiply(const Color& a, const Color& b, double scale) {
  const auto product = [scale](float x, float y) {
    return static_cast<float>(double{x} * double{y} * scale);
  };
  return {product(a.r, b.r), product(a.g, b.g), product(a.b, b.b)};
}

/// False only if a line along `dir` certainly passes the sphere: no root, no quotient. Its distance
/// from the centre is compared with twice the radius, and a little for what rounding takes from it.
bool may_meet(const Vec3d& dir, const Vec3d& to_center, double radius) {
  const Vec3d aside = cross(dir, to_center);
  return !(dot(aside, aside) >
           dot(dir, dir) * (4 * radius * radius + 1e-29 * dot(to_center, to_center)));
}

/// Veach's power heuristic with exponent 2: the share of the way with density a, beside one with b.
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
      seeks_(settings.light_sampling != LightSampling::paths &&
             (scene.environment.shines() || !scene.area_lights.empty())) {
  for (const Light& light : scene.lights) {
    if (std::holds_alternative<SphereLight>(light)) continue;
    use_light(light);
    delta_lights_ = true;
  }
  constexpr std::size_t most = StreamSurfaces::block_size;
  points_.reserve(most);
  seekers_.reserve(most);
  choices_.resize(most);
  numbers_.resize(most);
  seek_.resize(most);
  turns_.resize(most);
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
  arrivals_.clear();
  arrivals_.reserve(rays);
}

/// In steps that go through the whole block: what they calculate goes W at a time.
void Path::shade(const Block& block) {
  met_.clear();
  points_.clear();
  for (auto k = static_cast<std::uint32_t>(block.first); k < block.end; ++k) {
    if (const FlatMaterial* material = meet(block.stream, k)) met_.push_back({k, material});
  }
  if (met_.empty()) return;
  find_surfaces(block);
  for (const Met& met : met_) add_point(met, surfaces_.get(met.ray - block.first));
  if (seeks_) seek_lights(block.stream);
  if (!ends(block.stream)) go_on(block.stream);
}

/// Finds the radiance that a ray comes upon. The material from which its path may go on, or null.
const FlatMaterial* Path::meet(const PathStream& stream, std::uint32_t index) {
  const Hit met = hit(index);
  const double density = stream.density[index];
  Color& sum = radiance(index);
  sum = density > 0 ? crossed_lights(stream.rays->get(index), density, met.t) : Color{};
  if (met.id == no_primitive) {
    sum = sum + seen_background(stream.rays->dir(index), density);
    return nullptr;
  }
  const FlatMaterial& material = scene_.material_of(met.id);
  if (is_black(material.constant)) {
    return takes_direct_light(material) || scatters(material) ? &material : nullptr;
  }
  // Emissive: nothing else.
  const double sought = density > 0 ? sought_density(stream.rays->org(index), met.id) : 0;
  sum = sum + material.constant * static_cast<float>(weight_of_hit(density, sought));
  return nullptr;
}

/// The density with which an emissive primitive is sought, in any direction that meets it.
double Path::sought_density(const Vec3d& org, std::int32_t id) const {
  const auto sphere = static_cast<std::size_t>(id);
  if (sphere >= scene_.spheres.size()) return 0;
  const AreaLight light =
      scene_.area_lights.light_of(scene_.spheres[sphere], scene_.material_of(id).constant);
  return (1 - environment_share_) * light.share *
         LightCone(org, light.center, light.radius).density();
}

void Path::add_point(const Met& met, const Surface& surface) {
  const Point& point = points_.emplace_back(met.ray, *met.material, surface);
  if (point.lobes.black()) {
    points_.pop_back();
  } else if (point.lit && delta_lights_) {
    illumination_.add_point(met.ray, *met.material);
  }
}

/// Picks a light and a direction to it for each point: the environment, or one of the spheres.
void Path::seek_lights(const PathStream& stream) {
  find_numbers(stream, Use::light);
  seekers_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    if (!point.lit) continue;
    UnitPair numbers = numbers_.get(i);
    if (seek_environment(stream, point, numbers)) continue;
    const AreaLight& light = scene_.area_lights.pick(numbers.u);
    seek_.set(seekers_.size(), surfaces_.departure(point.ray).org, light.center, light.radius,
              numbers.u, numbers.v);
    seekers_.push_back({&point, &light});
  }
  seek_spheres(stream);
}

/// Seeks the environment if it is its turn; else the numbers become such for spheres.
bool Path::seek_environment(const PathStream& stream, const Point& point, UnitPair& numbers) {
  if (!(numbers.u < environment_share_)) {
    numbers.u = (numbers.u - environment_share_) / (1 - environment_share_);
    return false;
  }
  numbers.u /= environment_share_;
  const auto [to_light, density] = scene_.environment.sample(numbers);
  const Departure departure = surfaces_.departure(point.ray);
  const Ray way{departure.org, vec_cast<float>(to_light)};
  const Color radiance = background_radiance(scene_.background, way.dir);
  seek(stream, point, from_surface(way, departure),
       {to_light, environment_share_ * density, radiance});
  return true;
}

void Path::seek_spheres(const PathStream& stream) {
  kernels_.sample_cones(seek_.view(seekers_.size()));
  const double sphere_share = 1 - environment_share_;
  for (std::size_t i = 0; i < seekers_.size(); ++i) {
    const auto& [point, light] = seekers_[i];
    const Departure departure = surfaces_.departure(point->ray);
    const Vec3d direction = seek_.direction(i);
    Ray way{departure.org, vec_cast<float>(direction)};
    way.tmax = seek_.tmax(i);
    seek(stream, *point, from_surface(way, departure),
         {direction, sphere_share * light->share * seek_.density(i), light->radiance});
  }
}

/// Makes the shadow ray that decides whether a light arrives, unless none of it would count.
void Path::seek(const PathStream& stream, const Point& point, const Ray& way, const Sought& light) {
  const double cosine = dot(point.surface.normal, light.direction);
  if (!(cosine > 0) || !(light.density > 0)) return;
  const double density = point.lobes.density(cosine, light.direction);
  const double weight = weight_of_light(light.density, density, ends(stream));
  const Color reflected = point.lobes.reflected(cosine, light.direction);
  shadow_rays_.set(arrivals_.size(), way);
  arrivals_.push_back(
      {point.ray, multiply(reflected, light.radiance, weight / (elementary::pi * light.density))});
}

/// Sends all paths on, unless the roulette ends them.
void Path::go_on(const PathStream& stream) {
  choose_ways(stream);
  const bool may_end = stream.depth >= roulette_depth;
  if (may_end) find_numbers(stream, Use::roulette);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    Bounce bounce = point.lobes.bounce(choices_[i], turns_.direction(i));
    if (is_black(bounce.weight)) continue;
    if (may_end && !survives(stream, point, numbers_.get(i), bounce)) continue;
    wavefront_.spawn(point.ray, leave(point.surface, bounce.side, bounce.direction), bounce.weight,
                     static_cast<float>(bounce.density));
  }
}

/// Chooses each point's lobe and, where that is wide, the direction in it.
void Path::choose_ways(const PathStream& stream) {
  find_numbers(stream, Use::bounce);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const LobeSampler& lobes = points_[i].lobes;
    const LobeSampler::Choice& choice = choices_[i] = lobes.choose(numbers_.get(i));
    turns_.set(i, lobes.axis(choice), choice.from.cosine, choice.from.sine, choice.turns);
  }
  kernels_.to_world(turns_.view(points_.size()));
}

/// Roulette: what survives counts more by as much as others are lost.
bool Path::survives(const PathStream& stream, const Point& point, UnitPair numbers,
                    Bounce& bounce) {
  const Color left = stream.throughput[point.ray] * bounce.weight;
  const float survival = std::min(std::max({left.r, left.g, left.b}), most_likely);
  if (!(numbers.u < static_cast<double>(survival))) return false;
  bounce.weight = bounce.weight * (1 / survival);
  return true;
}

/// The numbers of all points for this use.
void Path::find_numbers(const PathStream& stream, Use use) {
  const RandomSet set = random_set(stream.depth, static_cast<unsigned>(use));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const RandomKey& key = random_keys_[stream.sample[points_[i].ray]];
    numbers_.ask(i, key.pixel, set, key.sample);
  }
  numbers_.find(kernels_, points_.size());
}

void Path::add_more_light() {
  if (arrivals_.empty()) return;
  RayStream rays = shadow_rays_.view();
  rays.size = arrivals_.size();
  const std::uint8_t* blocked = find_blocked(rays, Coherence::none);
  for (std::size_t k = 0; k < arrivals_.size(); ++k) {
    if (blocked[k] != 0) continue;
    Color& sum = radiance(arrivals_[k].ray);
    sum = sum + arrivals_[k].radiance;
  }
}

/// The background, weighted where an image of it is sought too.
Color Path::seen_background(const Vec3f& dir, double density) const {
  const Color radiance = background_radiance(scene_.background, dir);
  if (!(environment_share_ > 0) || !(density > 0)) return radiance;
  const double sought = scene_.environment.density(normalize(vec_cast<double>(dir)));
  return radiance * static_cast<float>(weight_of_hit(density, environment_share_ * sought));
}

/// The sphere lights that a ray passes before t: they are no objects, no ray ends there. Seen by
/// rays that a diffuse lobe or a highlight sent there with this density, and by no others.
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

/// What light counts that a path came upon by a direction of this density (0: of a camera or a
/// mirror), which the other way finds with `light_density`.
double Path::weight_of_hit(double density, double light_density) const {
  if (!(density > 0) || !(light_density > 0)) return 1;
  if (settings_.light_sampling == LightSampling::both)
    return power_heuristic(density, light_density);
  return settings_.light_sampling == LightSampling::paths ? 1 : 0;
}

/// What light counts that was sought with `light_density`, on which a path comes with `density`.
double Path::weight_of_light(double light_density, double density, bool last) const {
  if (last || settings_.light_sampling == LightSampling::lights) return 1;
  return power_heuristic(light_density, density);
}

}  // namespace boule
