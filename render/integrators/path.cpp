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
    : scene_(scene),
      kernels_(kernels),
      settings_(settings),
      geometry_(scene.geometry.view()),
      wavefront_(settings.stream_size),
      keys_(settings.seed),
      environment_share_(!scene.environment.shines() ? 0
                         : scene.area_lights.empty() ? 1
                                                     : 0.5),
      seeks_(settings.light_search != LightSearch::paths &&
             (scene.environment.shines() || !scene.area_lights.empty())) {
  for (const Light& light : scene.lights) {
    if (!std::holds_alternative<SphereLight>(light)) delta_lights_.push_back(&light);
  }
}

bool Path::trace(const CameraRays& camera, Color* radiance) {
  const std::size_t count = camera.rays.size();
  primary_ += count;
  if (random_keys_.size() < count) random_keys_.resize(std::bit_ceil(count));
  for (std::size_t k = 0; k < count; ++k) {
    const SampleId& id = camera.samples[k];
    random_keys_[k] = {keys_.of(id.x, id.y), static_cast<std::uint32_t>(id.sample)};
  }
  wavefront_.start(camera.rays);
  while (const PathStream* stream = wavefront_.next()) {
    if (cancelled()) return false;
    shade(*stream, stream->depth == 0 ? camera.coherence : Coherence::none);
  }
  wavefront_.finish(radiance);
  return true;
}

bool Path::cancelled() const {
  return settings_.cancel != nullptr && settings_.cancel->load(std::memory_order_relaxed);
}

void Path::shade(const PathStream& stream, Coherence coherence) {
  const std::size_t count = stream.rays->size();
  make_room(count);
  hits_.resize(count);
  const Query query{settings_.solver, Form::automatic, coherence};
  kernels_.closest_hit(geometry_, stream.rays->view(), query, hits_.view());
  find_points(stream);
  for (const Light* light : delta_lights_) add_light(*light);
  add_area_lights();
  for (std::size_t k = 0; k < count; ++k) wavefront_.add(k, radiance_[k]);
}

/// Makes room for what comes of so many rays, by powers of two: see Whitted.
void Path::make_room(std::size_t rays) {
  const std::size_t room = std::bit_ceil(rays);
  hits_.resize(room);
  occluded_.resize(room);
  shadow_rays_.resize(room);
  arrivals_.reserve(room);
  if (radiance_.size() < room) radiance_.resize(room);
  illumination_.start(rays);
}

void Path::find_points(const PathStream& stream) {
  arrivals_.clear();
  for (std::uint32_t k = 0; k < stream.rays->size(); ++k) {
    const Hit hit = hits_.get(k);
    const Ray ray = stream.rays->get(k);
    radiance_[k] = crossed_lights(ray, stream.density[k], hit.t);
    if (hit.id == no_primitive) {
      radiance_[k] = radiance_[k] + seen_background(ray, stream.density[k]);
    } else {
      shade_hit(stream, k, ray, hit);
    }
  }
}

void Path::shade_hit(const PathStream& stream, std::uint32_t index, const Ray& ray,
                     const Hit& hit) {
  const FlatMaterial& material = scene_.material_of(hit.id);
  if (!is_black(material.constant)) {  // emissive: nothing else
    const double density = stream.density[index];
    const auto sphere = static_cast<std::size_t>(hit.id);
    double light_density = 0;
    if (density > 0 && sphere < scene_.spheres.size()) {
      const AreaLight light =
          scene_.area_lights.light_of(scene_.spheres[sphere], material.constant);
      light_density = (1 - environment_share_) * light.share *
                      LightCone(ray.org, light.center, light.radius).density();
    }
    const auto weight = static_cast<float>(weight_of_hit(density, light_density));
    radiance_[index] = radiance_[index] + material.constant * weight;
    return;
  }
  const bool lit = takes_direct_light(material);
  if (!lit && !scatters(material)) return;
  const Surface surface = find_surface(scene_, ray, hit);
  const Lobes lobes(material, surface);
  if (lobes.black()) return;
  if (lit && !delta_lights_.empty()) illumination_.add_point(index, material, surface);
  if (lit && seeks_) seek_light(stream, index, surface, lobes);
  if (stream.depth < settings_.max_depth) go_on(stream, index, surface, lobes);
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
  const bool last = seeker.stream.depth == settings_.max_depth;
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

/// Adds a point or directional light to the points it reaches: one stream of shadow rays.
void Path::add_light(const Light& light) {
  const RayStream rays = illumination_.aim(light);
  if (rays.size == 0) return;
  shadow_ += rays.size;
  const Query query{settings_.solver, Form::automatic, shadow_coherence(light)};
  kernels_.any_hit(geometry_, rays, query, occluded_.data());
  illumination_.add_unblocked(light, occluded_.data(), radiance_.data());
}

void Path::add_area_lights() {
  if (arrivals_.empty()) return;
  shadow_ += arrivals_.size();
  RayStream rays = shadow_rays_.view();
  rays.size = arrivals_.size();
  const Query query{settings_.solver, Form::automatic, Coherence::none};
  kernels_.any_hit(geometry_, rays, query, occluded_.data());
  for (std::size_t k = 0; k < arrivals_.size(); ++k) {
    if (occluded_[k] != 0) continue;
    Color& sum = radiance_[arrivals_[k].ray];
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
