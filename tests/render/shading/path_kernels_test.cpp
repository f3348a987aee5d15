// The kernels of path tracing, of every table, against the scalar formulas, bit for bit.
#include <algorithm>
#include <vector>

#include "core/math/geometry.h"
#include "core/math/light_cone.h"
#include "render/prepare/area_lights.h"
#include "render/prepare/prepared_scene.h"
#include "render/shading/background_radiance.h"
#include "render/shading/path_material.h"
#include "simd/stream/path_buffers.h"
#include "tests/render/shading/kernel_rays.h"
#include "tests/render/shading/lobe_twin.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/test_scenes.h"

namespace boule::test {
namespace {

constexpr std::size_t count = 251;  // the last packet is not whole

double unit_number(CaseRandom& random) {
  if (random.chance(0.05)) return 0;
  return random.chance(0.05) ? 1 - 0x1p-32 : random.uniform(0, 1);
}

std::vector<LightSphere> some_lights(CaseRandom& random, std::size_t number) {
  std::vector<LightSphere> lights;
  const double share = 1 / static_cast<double>(number);
  for (std::size_t i = 0; i < number; ++i) {
    const Vec3d center = random.direction() * random.uniform(1, 12);
    lights.push_back({{center.x, center.y, center.z},
                      random.uniform(0.1, 2),
                      share,
                      share * static_cast<double>(i),
                      {static_cast<float>(random.uniform(0, 9)), 2, 1e-3F}});
  }
  return lights;
}

Color product_in_double(const Color& a, const Color& b, double scale) {
  const auto product = [scale](float x, float y) {
    return static_cast<float>(double{x} * double{y} * scale);
  };
  return {product(a.r, b.r), product(a.g, b.g), product(a.b, b.b)};
}

double heuristic(double a, double b) {
  const double ratio = b / a;
  return 1 / (1 + ratio * ratio);
}

/// Rays of a block, what they met, and how their paths shall go on.
class PathKernels : public OnEachIsa {
 protected:
  struct Options {
    std::size_t lights = 2;
    double environment_share = 0;
    bool weighs = true, roulette = false;
  };

  void make_rays() {
    std::vector<Ray> shot;
    for (std::size_t i = 0; i < count; ++i) {
      Ray ray{random.direction() * random.uniform(0, 3), vec_cast<float>(random.direction())};
      if (i % 9 == 0) ray.dir = ray.dir * 40.0F;
      shot.push_back(ray);
    }
    rays = to_stream(shot);
    hits.resize(count);
    kernels->closest_hit(scene.geometry.view(), rays.view(), {}, hits.view());
    throughput.resize(count);
    density.resize(count);
    kinds.resize(count);
    sample.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      throughput.set(i, {static_cast<float>(random.uniform(0, 1)), i % 7 == 0 ? 0.0F : 0.5F, 1});
      sample[i] = static_cast<std::uint32_t>(3 * i);
      density[i] = i % 3 == 0 ? 0 : static_cast<float>(random.uniform(0, 4));
    }
    meet();
  }

  void meet() {
    met.clear();
    for (const FlatMaterial& flat : scene.materials) met.emplace_back(flat);
    lobes.assign(count, nullptr);
    for (std::size_t i = 0; i < count; ++i) {
      if (hits.get(i).id == no_primitive) continue;
      const PathMaterial& material = met[scene.material_ref(hits.get(i)).index()];
      lobes[i] = &material.flat;
      kinds[i] = static_cast<std::uint32_t>(material.kind);
    }
  }

  struct Numbers {
    AlignedArray<double> u, v;
    Numbers(CaseRandom& random, double last) : u(count), v(count) {
      for (std::size_t i = 0; i < count; ++i) {
        u[i] = unit_number(random) * last;
        v[i] = unit_number(random);
      }
    }
    [[nodiscard]] UnitPairs view() const { return {u.data(), v.data()}; }
  };

  GivenLightBuffer given_by_chance(const AlignedArray<double>& picked, double share) {
    GivenLightBuffer given;
    given.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      given.set_none(i);
      if (picked[i] < share)
        given.set(i, random.direction(), i % 5 == 0 ? 0 : random.uniform(0, 3), {1, 2, 0.5F});
    }
    return given;
  }

  void check(const Options& options);
  void expect_point(std::size_t point, std::size_t ray, const PathStep& step);
  void expect_light(std::size_t point, std::size_t ray, const Surface& surface,
                    const LobeSampler& twin, const PathStep& step);
  void expect_bounce(std::size_t point, std::size_t ray, const Surface& surface,
                     const LobeSampler& twin, const PathStep& step);

  CaseRandom random{3};
  PreparedScene scene = scene_of_all(random, Method::path);
  RayBuffer rays;
  HitBuffer hits;
  ColorBuffer throughput;
  AlignedArray<float> density;
  AlignedArray<std::uint32_t> kinds, sample;
  std::vector<PathMaterial> met;
  std::vector<const FlatMaterial*> lobes;
  std::vector<Written> shadows, bounces;  ///< expected
};

/// What the scalar formulas make of a point: a shadow ray, and a ray that goes on.
void PathKernels::expect_point(std::size_t point, std::size_t ray, const PathStep& step) {
  const Surface surface = find_surface(scene, rays.get(ray), hits.get(ray));
  const FlatMaterial flat = scene.material_of(hits.get(ray));
  const LobeSampler twin(flat, surface);
  if (twin.black()) return;
  if (takes_direct_light(flat)) expect_light(point, ray, surface, twin, step);
  expect_bounce(point, ray, surface, twin, step);
}

void PathKernels::expect_light(std::size_t point, std::size_t ray, const Surface& surface,
                               const LobeSampler& twin, const PathStep& step) {
  const Departure departure = depart(surface, Side::viewer);
  Vec3d direction;
  double light_density = 0;
  Color radiance;
  float tmax = std::numeric_limits<float>::infinity();
  if (step.given.given != nullptr && step.given.given[point] != 0) {
    const GivenLight& given = step.given;
    direction = {given.direction.x[point], given.direction.y[point], given.direction.z[point]};
    light_density = given.density[point];
    radiance = {given.radiance.r[point], given.radiance.g[point], given.radiance.b[point]};
  } else {
    const double share = step.environment_share;
    double u = (step.light.u[point] - share) / (1 - share);
    std::size_t picked = 0;
    while (picked + 1 < step.light_count && step.lights[picked + 1].before <= u) ++picked;
    const LightSphere& light = step.lights[picked];
    u = std::clamp((u - light.before) / light.share, 0.0, below_one);
    const LightCone cone(departure.org, {light.center[0], light.center[1], light.center[2]},
                         light.radius);
    direction = cone.direction({u, step.light.v[point]});
    light_density = (1 - share) * light.share * cone.density();
    radiance = {light.radiance[0], light.radiance[1], light.radiance[2]};
    tmax = static_cast<float>(cone.free_distance(direction));
  }
  const double cosine = dot(surface.normal, direction);
  if (!(cosine > 0) || !(light_density > 0)) return;
  const double weight = step.weighs ? heuristic(light_density, twin.density(cosine, direction)) : 1;
  Ray shadow{departure.org, vec_cast<float>(direction)};
  shadow.tmax = tmax;
  shadows.push_back({from_surface(shadow, departure),
                     step.first_ray + static_cast<std::uint32_t>(ray),
                     product_in_double(twin.reflected(cosine, direction), radiance,
                                       weight / (elementary::pi * light_density))});
}

void PathKernels::expect_bounce(std::size_t point, std::size_t ray, const Surface& surface,
                                const LobeSampler& twin, const PathStep& step) {
  const LobeSampler::Choice choice = twin.choose({step.bounce.u[point], step.bounce.v[point]});
  Bounce bounce =
      twin.bounce(choice, direction_about(twin.axis(choice), choice.from, choice.turns));
  const Color before = throughput.get(ray);
  if (is_black(bounce.weight)) return;
  if (step.survival != nullptr) {
    const Color left = before * bounce.weight;
    const float survival = std::min(std::max({left.r, left.g, left.b}), 0.95F);
    if (!(step.survival[point] < static_cast<double>(survival))) return;
    bounce.weight = bounce.weight * (1 / survival);
  }
  const Color after = before * bounce.weight;
  if (is_black(after)) return;
  bounces.push_back({leave(surface, bounce.side, bounce.direction), sample[ray], after,
                     static_cast<float>(bounce.density)});
}

void PathKernels::check(const Options& options) {
  make_rays();
  const std::vector<LightSphere> lights = some_lights(random, options.lights);
  const Numbers light(random, 1), bounce(random, 1), roulette(random, 0.6);
  GivenLightBuffer given = given_by_chance(light.u, options.environment_share);
  const PathStep step{.material = lobes.data(),
                      .first_ray = 512,
                      .samples_lights = true,
                      .goes_on = true,
                      .weighs = options.weighs,
                      .lights = lights.data(),
                      .light_count = lights.size(),
                      .environment_share = options.environment_share,
                      .light = light.view(),
                      .bounce = bounce.view(),
                      .survival = options.roulette ? roulette.u.data() : nullptr,
                      .given = options.environment_share > 0 ? given.view() : GivenLight{}};
  LobePointBuffer buffers[3]{LobePointBuffer(count), LobePointBuffer(count),
                             LobePointBuffer(count)};
  LobePoints points[3] = {buffers[0].view(), buffers[1].view(), buffers[2].view()};
  kernels->find_points(scene.geometry.view(),
                       {rays.view(), hits.view(), kinds.data(), throughput.view(), sample.data()},
                       points[0], points[1], points[2]);
  SampledLightBuffer shadow_buffer;
  shadow_buffer.resize(count);
  GoingOnBuffer going_on_buffer;
  going_on_buffer.resize(count);
  SampledLights sampled = shadow_buffer.view();
  GoingOn going_on = going_on_buffer.view();
  kernels->continue_matte(points[0], step, sampled, going_on);
  kernels->continue_glossy(points[1], step, sampled, going_on);
  kernels->continue_clear(points[2], step, sampled, going_on);
  for (std::uint32_t kind = 1; kind <= 3; ++kind) {
    std::size_t point = 0;
    for (std::size_t ray = 0; ray < count; ++ray) {
      if (kinds[ray] == kind) expect_point(point++, ray, step);
    }
    EXPECT_EQ(points[kind - 1].size, point);
    EXPECT_GT(point, std::size_t{20});
  }
  EXPECT_GT(shadows.size(), count / 8);
  EXPECT_GT(bounces.size(), count / 8);
  expect_same_rays(written(sampled.rays, sampled.size, sampled.ray, sampled.radiance, nullptr),
                   shadows);
  expect_same_rays(
      written(going_on.rays, going_on.size, going_on.sample, going_on.throughput, going_on.density),
      bounces);
}

TEST_P(PathKernels, PathsContinueAsTheScalarOnes) { check({}); }
TEST_P(PathKernels, ManyLightsContinueAsTheScalarOnes) { check({.lights = 40}); }
TEST_P(PathKernels, SingleLightsContinueAsTheScalarOnes) { check({.lights = 1, .weighs = false}); }
TEST_P(PathKernels, SkyAndRouletteContinueAsScalar) {
  check({.environment_share = 0.5, .roulette = true});
}

/// The light that a ray finds by its direction, by the scalar formulas.
Color seen_by(const Ray& ray, const Hit& hit, double density, const SeenLight& seen,
              const Background& background) {
  Color sum;
  const Vec3d dir = vec_cast<double>(ray.dir);
  const double size = length(dir);
  for (std::size_t i = 0; density > 0 && i < seen.light_count; ++i) {
    const LightSphere& light = seen.lights[i];
    const LightCone cone(ray.org, {light.center[0], light.center[1], light.center[2]},
                         light.radius);
    if (!cone.meets(dir * (1 / size), hit.t * size)) continue;
    const double other = seen.sphere_share * light.share * cone.density();
    double weight = 1;
    if (seen.weight != HitWeight::full && other > 0)
      weight = seen.weight == HitWeight::none ? 0 : heuristic(density, other);
    sum = sum + Color{light.radiance[0], light.radiance[1], light.radiance[2]} *
                    static_cast<float>(weight);
  }
  if (hit.id == no_primitive) sum = sum + background_radiance(background, ray.dir);
  return sum;
}

TEST_P(PathKernels, EmittedLightEqualsTheScalarPaths) {
  make_rays();
  const std::vector<LightSphere> lights = some_lights(random, 9);
  const GradientBackground gradient{{0.1f, 0.2f, 0.3f}, {0.9f, 0.7f, 0.5f}, {1, 2, -0.5f}};
  const Vec3d up = normalize(vec_cast<double>(gradient.up));
  const SeenBackground slope{
      SeenBackground::Kind::gradient, {0.1f, 0.2f, 0.3f}, {0.9f, 0.7f, 0.5f}, {up.x, up.y, up.z}};
  const SeenBackground flat{SeenBackground::Kind::constant, {0.5f, 0.25f, 1}, {}, {}};
  for (const HitWeight weight : {HitWeight::heuristic, HitWeight::full, HitWeight::none}) {
    for (const bool sloped : {true, false}) {
      const SeenLight seen{sloped ? slope : flat, lights.data(), lights.size(), 0.5, weight};
      ColorBuffer radiance;
      radiance.resize(count);
      kernels->see_light(seen, {rays.view(), hits.view(), density.data(), radiance.view()});
      const Background background =
          sloped ? Background{gradient} : Background{ConstantBackground{{0.5f, 0.25f, 1}}};
      for (std::size_t k = 0; k < count && !HasFailure(); ++k) {
        SCOPED_TRACE(k);
        expect_same_color(radiance.get(k),
                          seen_by(rays.get(k), hits.get(k), double{density[k]}, seen, background));
      }
    }
  }
}

/// Rays that pass by the rim of a light, or within it, from next to it to so far away that floats
/// cannot tell which.
TEST_P(PathKernels, RimsOfLightsEqualTheScalarPaths) {
  const Background black{ConstantBackground{}};
  for (int k = 0; k < 10; ++k) {
    const Vec3d center = random.direction() * random.uniform(0, 9);
    const double radius = random.uniform(0.01, 2);
    const LightSphere light{{center.x, center.y, center.z}, radius, 1, 0, {1, 2, 3}};
    std::vector<Ray> passing;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3f dir = vec_cast<float>(random.direction() * (i % 9 == 0 ? 0x1p-22 : 1.0));
      const Vec3d unit = normalize(vec_cast<double>(dir));
      const Vec3d aside = random.perpendicular(unit) * (radius * random.uniform(0.7, 1.1));
      passing.push_back({center + aside - unit * (radius * random.decade(k, k + 1)), dir});
    }
    rays = to_stream(passing);
    hits.resize(count);
    kernels->closest_hit(Geometry({}, {}).view(), rays.view(), {}, hits.view());
    const SeenLight seen{{}, &light, 1, 1, HitWeight::full};
    AlignedArray<float> densities(count, 1);
    ColorBuffer radiance;
    radiance.resize(count);
    kernels->see_light(seen, {rays.view(), hits.view(), densities.data(), radiance.view()});
    std::size_t met_rays = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Color expected = seen_by(rays.get(i), hits.get(i), 1, seen, black);
      met_rays += expected.r > 0 ? 1U : 0U;
      ASSERT_EQ(radiance.get(i), expected) << "ray " << i << ", decade " << k;
    }
    EXPECT_GT(met_rays, count / 2) << k;
    EXPECT_LT(met_rays, count) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, PathKernels, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
