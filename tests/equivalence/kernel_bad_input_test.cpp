// What kernel_table.h says about bad input, for every kernel: no rays, NaN and infinity,
// enumerators without a name, broken promises, a caller's float environment. contract_test.cpp has
// single rays and primitives.
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/float_environment.h"
#include "core/math/geometry.h"
#include "core/optics/camera_builder.h"
#include "simd/stream/path_buffers.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/odd_float_environment.h"

namespace boule::test::kernel_bad_input {
namespace {

constexpr auto inf = std::numeric_limits<float>::infinity();
constexpr auto nan = std::numeric_limits<float>::quiet_NaN();

/// The kernels of each ISA, and the reference's.
class KernelBadInput : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    kernels = GetParam() == "reference" ? &reference_kernels() : kernels_or_null(GetParam());
    if (kernels == nullptr) GTEST_SKIP() << "this CPU has no " << GetParam();
  }

  const KernelTable* kernels = nullptr;
};

std::vector<std::string> all_tables() {
  std::vector<std::string> names = all_isa_names();
  names.emplace_back("reference");
  return names;
}
INSTANTIATE_TEST_SUITE_P(Tables, KernelBadInput, testing::ValuesIn(all_tables()), isa_name);

std::vector<Sphere> cloud(int count) {
  std::vector<Sphere> spheres;
  CaseRandom random(5);
  for (int i = 0; i < count; ++i) {
    const Vec3d way = random.direction();
    spheres.push_back({vec_cast<float>(way * random.uniform(0, 3)), 0.1F, 0});
  }
  return spheres;
}
const std::vector<Plane> floors = {{{0, -3, 0}, {0, 1, 0}, 0}};

std::vector<Ray> rays_from(const Vec3d& eye, int count) {
  std::vector<Ray> rays;
  CaseRandom random(6);
  for (int i = 0; i < count; ++i) rays.push_back({eye, vec_cast<float>(random.direction())});
  return rays;
}

constexpr Coherence promises[] = {Coherence::none, Coherence::common_origin,
                                  Coherence::common_direction, Coherence::common_end};

TEST_P(KernelBadInput, EmptyStreamsMayHaveNullPointers) {
  const Geometry geometry(cloud(200), floors), nothing({}, {});
  const RayStream rays{};
  for (const GeometryView& view : {geometry.view(), nothing.view()}) {
    for (const Coherence promise : promises) {
      const Query query{Solver::robust, Form::automatic, promise};
      kernels->closest_hit(view, rays, query, {});
      kernels->any_hit(view, rays, query, nullptr);
    }
    kernels->find_surfaces(view, rays, {}, {});
  }
  kernels->primary_rays(build_camera(PinholeCamera{}, 4, 3), {}, rays);
  EXPECT_EQ(kernels->make_shadow_rays({}, {}, {}), 0U);
  kernels->sobol_points({});
  kernels->see_light({}, {});
  kernels->add_weighted_light({}, nullptr);
  LobePoints points{};
  SampledLights shadows{};
  GoingOn going_on{};
  kernels->find_points(geometry.view(), {}, points, points, points);
  kernels->continue_matte(points, {}, shadows, going_on);
  kernels->continue_glossy(points, {}, shadows, going_on);
  kernels->continue_clear(points, {}, shadows, going_on);
  kernels->scatter_rays({}, going_on);
  kernels->add_direct_light({}, {}, {});
  EXPECT_EQ(points.size + shadows.size + going_on.size, 0U);
}

TEST_P(KernelBadInput, UnnamedEnumeratorsMeanRobustAndAutomatic) {
  const Geometry geometry(cloud(200), floors);
  const std::vector<Ray> rays = rays_from({0, 0, 5}, 300);
  const Query odd{static_cast<Solver>(9), static_cast<Form>(9), static_cast<Coherence>(9)};
  const auto expected = run_closest(*kernels, geometry.view(), rays, {});
  const auto found = run_closest(*kernels, geometry.view(), rays, odd);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_TRUE(same_bits(found[i], expected[i])) << i;
  EXPECT_EQ(run_any(*kernels, geometry.view(), rays, odd),
            run_any(*kernels, geometry.view(), rays, {}));
}

/// A broken promise may lose hits, but every hit that is found is an intersection with the
/// primitive it names.
TEST_P(KernelBadInput, BrokenPromisesInventNoHits) {
  const std::vector<Sphere> spheres = cloud(2000);
  const Geometry geometry(spheres, floors);
  std::vector<Ray> rays = rays_from({0, 0, 5}, 3000);
  CaseRandom random(7);
  for (Ray& ray : rays) ray.org = random.direction() * random.decade(-3, 3);
  rays[100].dir = {nan, 0, 1};
  rays[1000].org.x = double{inf};
  rays[1001].dir = {};
  for (const Coherence promise : promises) {
    const Query query{Solver::robust, Form::automatic, promise};
    if (promise != Coherence::common_end) {
      const auto hits = run_closest(*kernels, geometry.view(), rays, query);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto id = static_cast<std::size_t>(hits[i].id);
        if (hits[i].id == no_primitive) continue;
        ASSERT_LT(id, spheres.size() + 1);
        ASSERT_EQ(hits[i].t, id < spheres.size() ? reference::intersect(rays[i], spheres[id], false)
                                                 : reference::intersect(rays[i], floors[0], false));
      }
    }
    const auto occluded = run_any(*kernels, geometry.view(), rays, query);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (occluded[i] == 0) continue;
      ASSERT_EQ(occluded[i], 1);
      ASSERT_TRUE(reference::any_hit(rays[i], spheres, floors));
    }
    for (const std::size_t i : {100U, 1000U, 1001U}) EXPECT_EQ(occluded[i], 0);
  }
}

std::vector<Camera> odd_cameras() {
  std::vector<Camera> cameras = {LensCamera{}};  // without surfaces, or without its lens
  for (const float odd : {nan, inf, 0.0F, -1.0F}) {
    const CameraPose nowhere{{odd, 0, odd}, {}, {0, odd, 0}};
    cameras.insert(cameras.end(),
                   {PinholeCamera{nowhere}, OrthographicCamera{nowhere}, FisheyeCamera{nowhere},
                    PinholeCamera{{}, odd}, FisheyeCamera{{}, odd}, OrthographicCamera{{}, odd},
                    ThinLensCamera{{}, 45, FovAxis::x, odd, odd}});
  }
  return cameras;
}

TEST_P(KernelBadInput, RaysOfOddCamerasAreHarmless) {
  const Geometry geometry(cloud(100), {});
  constexpr std::size_t count = 40;
  for (const Camera& camera : odd_cameras()) {
    const CameraView view = build_camera(camera, 8, 5);
    SampleBuffer samples;
    samples.resize(count, view);
    for (std::size_t i = 0; i < count; ++i) {
      const auto x = static_cast<double>(i % 8) + 0.5, y = static_cast<double>(i) / 8 + 0.5;
      samples.set(i, i == 7 ? double{nan} : x, i == 9 ? double{inf} : y);
    }
    RayBuffer rays(count);
    HitBuffer hits(count);
    kernels->primary_rays(view, samples.view(), rays.view());
    kernels->closest_hit(geometry.view(), rays.view(), {}, hits.view());
    const bool lens = std::holds_alternative<LensCamera>(camera);
    for (std::size_t i = 0; i < count; ++i) {
      if (lens) {
        EXPECT_EQ(samples.weight(i), 0);
      }
      if (view.weighs && samples.weight(i) == 0) continue;
      const Ray ray = rays.get(i);
      if (!is_finite(ray.org) || !is_finite(ray.dir)) {
        EXPECT_EQ(hits.get(i).id, no_primitive);
      }
    }
  }
}

TEST_P(KernelBadInput, InvalidLightsGiveNoLight) {
  constexpr std::size_t count = 20;
  const double odd[] = {double{nan}, double{inf}, 0};
  FlatMaterial white;
  white.diffuse = gray(1);
  std::vector<const FlatMaterial*> materials(count, &white);
  const AlignedArray<double> half(count, 0.5);
  LobePointBuffer buffer(count);
  SampledLightBuffer shadow_buffer;
  shadow_buffer.resize(count);
  for (const double bad : odd) {
    LobePoints points = buffer.view();
    points.size = count;
    for (std::size_t i = 0; i < count; ++i) {
      points.ray[i] = static_cast<std::uint32_t>(i);
      points.org.z[i] = i % 2 == 0 ? bad : 5;
      points.normal.z[i] = -1;
    }
    const LightSphere light{{0, 0, 0}, bad, 1, 0, {1, 1, 1}};
    PathStep step{};
    step.material = materials.data();
    step.samples_lights = true;
    step.lights = &light;
    step.light_count = 1;
    step.light = step.bounce = {half.data(), half.data()};
    SampledLights shadows = shadow_buffer.view();
    GoingOn going_on{};
    kernels->continue_matte(points, step, shadows, going_on);
    EXPECT_EQ(shadows.size, 0U) << bad;
  }
}

/// A FloatEnvironment is enough, whatever the caller has set, traps included.
TEST_P(KernelBadInput, OneFloatEnvironmentPerCallIsEnough) {
  const Geometry geometry(cloud(2000), floors);
  std::vector<Ray> rays = rays_from({0, 0.1, 5}, 2000);
  for (std::size_t i = 0; i < rays.size(); i += 7) rays[i].dir.x = i % 2 == 0 ? nan : 0;
  for (std::size_t i = 3; i < rays.size(); i += 7) rays[i].dir.z = 1e-42F;
  for (const Coherence promise : {Coherence::none, Coherence::common_origin}) {
    const Query query{Solver::robust, Form::automatic, promise};
    RayBuffer stream = to_stream(rays);
    HitBuffer expected(rays.size()), found(rays.size());
    kernels->closest_hit(geometry.view(), stream.view(), query, expected.view());
    for (const Oddity oddity : oddities) {
      bool stayed = false;
      {
        const OddFloatEnvironment odd(oddity);
        {
          const FloatEnvironment plain;
          kernels->closest_hit(geometry.view(), stream.view(), query, found.view());
        }
        stayed = odd.holds();
      }
      EXPECT_TRUE(stayed) << oddity;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(same_bits(found.get(i), expected.get(i))) << oddity << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace boule::test::kernel_bad_input
