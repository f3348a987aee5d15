#include "render/integrators/path.h"

#include <algorithm>
#include <bit>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "render/shading/background.h"
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
      seeks_(settings.light_search != LightSearch::paths &&
             (scene.environment.shines() || !scene.area_lights.empty())) {
  for (const Light& light : scene.lights) {
    if (std::holds_alternative<SphereLight>(light)) continue;
    use_light(light);
    delta_lights_ = true;
  }
  points_.reserve(Surfaces::block_size);
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

void Path::shade(const Block& block) {
  points_.clear();
  for (std::size_t k = block.first; k < block.end; ++k) {
    const auto index = static_cast<std::uint32_t>(k);
    if (meet(block.stream, index)) points_.push_back(index);
  }
  if (points_.empty()) return;
  find_surfaces(block);
  for (const std::uint32_t index : points_) {
    shade_hit(block.stream, index, surfaces_.get(index - block.first));
  }
}

/// Finds the radiance that a ray comes upon. True if its path may go on from a surface.
bool Path::meet(const PathStream& stream, std::uint32_t index) {
  const Hit met = hit(index);
  const Ray ray = stream.rays->get(index);
  const double density = stream.density[index];
  Color& sum = radiance(index);
  sum = crossed_lights(ray, density, met.t);
  if (met.id == no_primitive) {
    sum = sum + seen_background(ray, density);
    return false;
  }
  const FlatMaterial& material = scene_.material_of(met.id);
  if (is_black(material.constant)) return takes_direct_light(material) || scatters(material);
  // Emissive: nothing else.
  const auto sphere = static_cast<std::size_t>(met.id);
  double light_density = 0;
  if (density > 0 && sphere < scene_.spheres.size()) {
    const AreaLight light = scene_.area_lights.light_of(scene_.spheres[sphere], material.constant);
    light_density = (1 - environment_share_) * light.share *
                    LightCone(ray.org, light.center, light.radius).density();
  }
  sum = sum + material.constant * static_cast<float>(weight_of_hit(density, light_density));
  return false;
}

void Path::shade_hit(const PathStream& stream, std::uint32_t index, const Surface& surface) {
  const FlatMaterial& material = scene_.material_of(surface.id);
  const Lobes lobes(material, surface);
  if (lobes.black()) return;
  const bool lit = takes_direct_light(material);
  if (lit && delta_lights_) illumination_.add_point(index, material);
  if (lit && seeks_) seek_light(stream, index, surface, lobes);
  if (!ends(stream)) go_on(stream, index, surface, lobes);
}

/// Picks a light and a direction to it: the environment, or one of the spheres.
void Path::seek_light(const PathStream& stream, std::uint32_t index, const Surface& surface,
                      const Lobes& lobes) {
  UnitPair numbers = this->numbers(stream, index, Use::light);
  const Departure departure = depart(surface, Side::viewer);
  if (numbers.u < environment_share_) {
    numbers.u /= environment_share_;
    const auto [to_light, density] = scene_.environment.sample(numbers);
    const Ray way{departure.org, vec_cast<float>(to_light)};
    const Color radiance = background_radiance(scene_.background, way.dir);
    seek({stream, index, surface, lobes}, from_surface(way, departure),
         {to_light, environment_share_ * density, radiance});
    return;
  }
  const double sphere_share = 1 - environment_share_;
  numbers.u = (numbers.u - environment_share_) / sphere_share;
  const AreaLight& light = scene_.area_lights.pick(numbers.u);
  const LightCone cone(departure.org, light.center, light.radius);
  if (!(cone.density() > 0)) return;
  const Vec3d to_light = cone.direction(numbers);
  seek({stream, index, surface, lobes}, from_surface(cone.way(to_light), departure),
       {to_light, sphere_share * light.share * cone.density(), light.radiance});
}

/// Makes the shadow ray that decides whether a light arrives, unless none of it would count.
void Path::seek(const Seeker& seeker, const Ray& way, const Sought& light) {
  const double cosine = dot(seeker.surface.normal, light.direction);
  if (!(cosine > 0) || !(light.density > 0)) return;
  const double density = seeker.lobes.density(cosine, light.direction);
  const bool last = ends(seeker.stream);
  const double weight = weight_of_light(light.density, density, last);
  const Color reflected = seeker.lobes.reflected(cosine, light.direction);
  shadow_rays_.set(arrivals_.size(), way);
  arrivals_.push_back(
      {seeker.ray, multiply(reflected, light.radiance, weight / (elementary::pi * light.density))});
}

/// Sends the path on, unless the roulette ends it.
void Path::go_on(const PathStream& stream, std::uint32_t index, const Surface& surface,
                 const Lobes& lobes) {
  Bounce bounce = lobes.bounce(numbers(stream, index, Use::bounce));
  if (is_black(bounce.weight)) return;
  if (stream.depth >= roulette_depth) {
    const Color left = stream.throughput[index] * bounce.weight;
    const float survival = std::min(std::max({left.r, left.g, left.b}), most_likely);
    if (!(numbers(stream, index, Use::roulette).u < static_cast<double>(survival))) return;
    bounce.weight = bounce.weight * (1 / survival);
  }
  wavefront_.spawn(index, leave(surface, bounce.side, bounce.direction), bounce.weight,
                   static_cast<float>(bounce.density));
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
Color Path::seen_background(const Ray& ray, double density) const {
  const Color radiance = background_radiance(scene_.background, ray.dir);
  if (!(environment_share_ > 0) || !(density > 0)) return radiance;
  const double sought = scene_.environment.density(normalize(vec_cast<double>(ray.dir)));
  return radiance * static_cast<float>(weight_of_hit(density, environment_share_ * sought));
}

/// The sphere lights that a ray passes before t: they are no objects, no ray ends there. Seen by
/// rays that a diffuse lobe or a highlight sent there, and by no others.
Color Path::crossed_lights(const Ray& ray, double density, double t) const {
  Color sum;
  const AreaLights& lights = scene_.area_lights;
  if (!(density > 0) || lights.sphere_light_count() == 0) return sum;
  const Vec3d dir = vec_cast<double>(ray.dir);
  const double size = length(dir);
  for (std::size_t i = 0; i < lights.sphere_light_count(); ++i) {
    const AreaLight& light = lights.sphere_lights()[i];
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
  if (settings_.light_search == LightSearch::both) return power_heuristic(density, light_density);
  return settings_.light_search == LightSearch::paths ? 1 : 0;
}

/// What light counts that was sought with `light_density`, on which a path comes with `density`.
double Path::weight_of_light(double light_density, double density, bool last) const {
  if (last || settings_.light_search == LightSearch::lights) return 1;
  return power_heuristic(light_density, density);
}

UnitPair Path::numbers(const PathStream& stream, std::uint32_t index, Use use) const {
  const RandomKey& key = random_keys_[stream.sample[index]];
  return sobol_pair(key.pixel, random_set(stream.depth, static_cast<unsigned>(use)), key.sample);
}

}  // namespace boule
