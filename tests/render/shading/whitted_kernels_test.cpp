// The kernels of Whitted's method, of every table, against the scalar formulas, bit for bit.
#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "core/math/geometry.h"
#include "render/shading/lights.h"
#include "render/shading/path_material.h"
#include "simd/stream/path_buffers.h"
#include "simd/stream/surface_buffer.h"
#include "tests/render/shading/direct_light_twin.h"
#include "tests/render/shading/kernel_rays.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::whitted_kernels {
namespace {

constexpr std::size_t count = 251;  // the last packet is not whole

/// light_product() of the renderer.
float product(float a, float b) { return a == 0 || b == 0 ? 0 : a * b; }

/// Rays of a block, the surfaces that they met, and their materials.
class WhittedKernels : public OnEachIsa {
 protected:
  void make_rays(Method method) {
    scene = scene_of_all(random, method);
    met.clear();
    for (const FlatMaterial& flat : scene->materials) met.emplace_back(flat);
    std::vector<Ray> shot;
    for (std::size_t i = 0; i < count; ++i)
      shot.push_back(
          {random.direction() * random.uniform(0, 3), vec_cast<float>(random.direction())});
    rays = to_stream(shot);
    hits.resize(count);
    kernels->closest_hit(scene->geometry.view(), rays.view(), {}, hits.view());
    surfaces.resize(count);
    kernels->find_surfaces(scene->geometry.view(), rays.view(), hits.view(), surfaces.stream());
    of_ray.assign(count, nullptr);
    lobes.assign(count, nullptr);
    for (std::size_t i = 0; i < count; ++i) {
      if (is_hit(i)) set_material(i, met[scene->material_ref(hits.get(i)).index()]);
    }
  }
  void set_material(std::size_t i, const WhittedMaterial& material) {
    of_ray[i] = &material;
    lobes[i] = &material.flat;
  }

  [[nodiscard]] bool is_hit(std::size_t i) const { return hits.get(i).id != no_primitive; }
  [[nodiscard]] const WhittedMaterial& material(std::size_t i) const { return *of_ray[i]; }
  [[nodiscard]] bool takes_light(std::size_t i) const {
    return is_hit(i) && material(i).takes_light;
  }
  [[nodiscard]] Surface surface(std::size_t i) const {
    return find_surface(*scene, rays.get(i), hits.get(i));
  }

  /// What the scalar formulas send on from a hit.
  void expect_scattered(std::size_t i, const Color& before, std::uint32_t sample,
                        std::vector<Written>& expected) const {
    const Surface met_surface = surface(i);
    const Scatter weights = scatter(material(i).flat, met_surface);
    const auto add = [&](Side side, const Vec3d& direction, const Color& weight) {
      const Color after{product(before.r, weight.r), product(before.g, weight.g),
                        product(before.b, weight.b)};
      if (!is_black(after))
        expected.push_back({leave(met_surface, side, direction), sample, after});
    };
    add(Side::viewer, met_surface.mirrored, weights.reflection);
    add(Side::beyond, weights.refracted, weights.refraction);
  }

  void check_scattering(bool sparse);
  void check_light(const Light& light, Method method);
  void check_added(const Light& light, std::size_t size);

  CaseRandom random{4};
  std::optional<PreparedScene> scene;
  std::vector<WhittedMaterial> met;
  RayBuffer rays;
  HitBuffer hits;
  SurfaceBuffer surfaces;
  std::vector<const WhittedMaterial*> of_ray;
  std::vector<const FlatMaterial*> lobes;
  // By shadow ray:
  VectorBuffer to_light;
  AlignedArray<double> cosine;
  AlignedArray<std::uint32_t> ray;
};

void WhittedKernels::check_scattering(bool sparse) {
  make_rays(Method::whitted);
  ColorBuffer throughput;
  throughput.resize(count);
  AlignedArray<std::uint32_t> sample(count);
  AlignedArray<std::uint8_t> scatters(count);
  std::fill_n(scatters.data(), padded(count), std::uint8_t{0});
  std::vector<Written> expected;
  std::size_t sending = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Color before{static_cast<float>(random.uniform(0, 1)), i % 7 == 0 ? 0.0F : 0.5F,
                       i % 11 == 0 ? 0.0F : 1.0F};
    throughput.set(i, before);
    sample[i] = static_cast<std::uint32_t>(3 * i);
    if (!is_hit(i) || !material(i).sends_on || (sparse && i % 6 != 0)) continue;
    scatters[i] = 1;
    ++sending;
    expect_scattered(i, before, sample[i], expected);
  }
  GoingOnBuffer buffer;
  buffer.resize(2 * count);
  GoingOn spawned = buffer.view();
  kernels->scatter_rays({scatters.data(), surfaces.stream(), lobes.data(), hits.view().id,
                         scene->geometry.view().planes.first_id,
                         static_cast<std::uint32_t>(scene->geometry.view().planes.size),
                         throughput.view(), sample.data(), count},
                        spawned);
  EXPECT_GT(sending, sparse ? count / 16 : count / 4);
  EXPECT_GT(expected.size(), sending);  // glass sends two
  expect_same_rays(
      written(spawned.rays, spawned.size, spawned.sample, spawned.throughput, spawned.density),
      expected);
}

TEST_P(WhittedKernels, RaysScatterAsTheScalarOnes) { check_scattering(false); }
TEST_P(WhittedKernels, FewRaysScatterAsTheScalarOnes) { check_scattering(true); }

void WhittedKernels::check_light(const Light& light, Method method) {
  make_rays(method);
  AlignedArray<std::uint8_t> lit(count);
  std::fill_n(lit.data(), padded(count), std::uint8_t{0});
  for (std::size_t i = 0; i < count; ++i) lit[i] = takes_light(i) ? 1 : 0;
  RayBuffer shadow_rays(count);
  to_light.resize(count);
  cosine.resize(count);
  ray.resize(count);
  const std::size_t size =
      kernels->make_shadow_rays(shadow_target(light),
                                {surfaces.point.view(), surfaces.normal.view(), surfaces.org.view(),
                                 hits.view().id, surfaces.inside.data(), lit.data(), count},
                                {shadow_rays.view(), to_light.view(), cosine.data(), ray.data()});
  ASSERT_GT(size, count / 8);
  check_added(light, size);
}

/// The light of the first `size` shadow rays, of which some are blocked.
void WhittedKernels::check_added(const Light& light, std::size_t size) {
  AlignedArray<std::uint8_t> blocked(count);
  ColorBuffer radiance;
  radiance.resize(count);
  std::vector<Color> expected(count);
  for (std::size_t i = 0; i < count; ++i) {
    expected[i] = {static_cast<float>(random.uniform(0, 1)), 0.25F, 0};
    radiance.set(i, expected[i]);
  }
  for (std::size_t k = 0; k < size; ++k) {
    blocked[k] = random.chance(0.3) || !takes_light(ray[k]) ? 1 : 0;
    if (blocked[k] != 0) continue;
    const Surface at = surface(ray[k]);
    const Color intensity =
        std::visit([&](const auto& any) { return intensity_at(any, at.point); }, light);
    expected[ray[k]] = expected[ray[k]] + direct_light(material(ray[k]).flat, cosine[k],
                                                       to_light.get(k), at.mirrored, intensity);
  }
  kernels->add_direct_light(light_intensity(light),
                            {blocked.data(), to_light.view(), cosine.data(), ray.data(), size,
                             surfaces.point.view(), surfaces.mirrored.view(), lobes.data()},
                            radiance.view());
  for (std::size_t i = 0; i < count && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    expect_same_color(radiance.get(i), expected[i]);
  }
}

TEST_P(WhittedKernels, PointsGetTheLightOfAPoint) {
  check_light(PointLight{{1, 2, 0.5f}, {3, 2, 1}, Falloff::none}, Method::whitted);
  check_light(PointLight{{-1, 2, 0.5f}, {30, 20, 10}, Falloff::inverse_square}, Method::whitted);
}
TEST_P(WhittedKernels, PointsGetTheLightOfTheSun) {
  check_light(DirectionalLight{{1, -2, 0.5f}, {3, 2, 1}}, Method::whitted);
}
TEST_P(WhittedKernels, PointsGetTheLightOfABall) {
  check_light(SphereLight{{0, 1, 1}, 0.5f, {3, 2, 1}}, Method::whitted);
}
TEST_P(WhittedKernels, PointsGetTheHighlightsOfPaths) {
  check_light(PointLight{{1, 2, 0.5f}, {3, 2, 1}, Falloff::none}, Method::path);
}

/// As where a whole block of pixels sees the light: rays in rows, many with one material.
TEST_P(WhittedKernels, PointsInARowGetLight) {
  make_rays(Method::whitted);
  std::size_t one = 0;
  while (!takes_light(one)) ++one;
  for (std::size_t i = 64; i < 160; ++i) {
    if (is_hit(i)) set_material(i, material(one));
  }
  to_light.resize(count);
  cosine.resize(count);
  ray.resize(count);
  std::size_t size = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % 41 == 0) continue;  // between two rows
    ray[size] = i;
    cosine[size] = random.uniform(0.1, 1);
    to_light.set(size++, random.direction());
  }
  check_added(PointLight{{1, 2, 0.5f}, {3, 2, 1}, Falloff::inverse_square}, size);
  check_added(DirectionalLight{{1, -2, 0.5f}, {3, 2, 1}}, size);
}

TEST_P(WhittedKernels, SamplesSumTheirRaysInOrder) {
  constexpr std::size_t samples = 20;
  constexpr float inf = std::numeric_limits<float>::infinity();
  ColorBuffer throughput, radiance;
  throughput.resize(count);
  radiance.resize(count);
  AlignedArray<std::uint32_t> sample(count);
  std::vector<ColorSum> sums(samples);
  std::vector<Color> expected(samples);
  for (std::size_t i = 0; i < count; ++i) {
    const Color weight{i % 5 == 0 ? 0.0F : static_cast<float>(random.uniform(0, 1)), 0.3F, 1};
    const Color light{i % 10 == 0 ? inf : static_cast<float>(random.decade(-3, 3)),
                      i % 7 == 0 ? 0.0F : 2.0F, static_cast<float>(random.decade(-3, 3))};
    throughput.set(i, weight);
    radiance.set(i, light);
    sample[i] = static_cast<std::uint32_t>(i < count / 2 ? i % samples : random.uniform(0, 19.99));
    expected[sample[i]] =
        expected[sample[i]] +
        Color{product(weight.r, light.r), product(weight.g, light.g), product(weight.b, light.b)};
  }
  kernels->add_weighted_light({throughput.view(), radiance.view(), sample.data(), count},
                              sums.data());
  for (std::size_t i = 0; i < samples; ++i) {
    const auto& [r, g, b, zero] = sums[i].rgb0;
    expect_same_color({r, g, b}, expected[i]);
    EXPECT_EQ(zero, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, WhittedKernels, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::whitted_kernels
