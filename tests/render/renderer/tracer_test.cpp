#include "render/renderer/tracer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "core/surface.h"
#include "render/integrators/aovs.h"
#include "render/prepare/prepared_scene.h"
#include "simd/dispatch/dispatch.h"
#include "simd/stream/stream_buffer.h"
#include "tests/render/ray_clouds.h"
#include "tests/support/test_scenes.h"

namespace boule::test::tracer {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr Solver solvers[] = {Solver::fast, Solver::robust, Solver::reference};

Tracer make_tracer(const Scene& scene, const TraceOptions& options = {}) {
  return Tracer::create(scene, options).value();
}

std::vector<TracedHit> closest(Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<TracedHit> hits(rays.size());
  const Status status = tracer.closest(rays, hits);
  EXPECT_TRUE(status) << status.error().message;
  return hits;
}
std::vector<TracedHit> closest(const Scene& scene, const std::vector<Ray>& rays,
                               const TraceOptions& options = {}) {
  Tracer tracer = make_tracer(scene, options);
  return closest(tracer, rays);
}
TracedHit closest(const Scene& scene, const Ray& ray) { return closest(scene, {{ray}})[0]; }

std::vector<std::uint8_t> any(Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<std::uint8_t> met(rays.size(), 255);
  const Status status = tracer.any(rays, met);
  EXPECT_TRUE(status) << status.error().message;
  return met;
}

/// The hit by the scalar reference, with the normal of shading.
std::vector<TracedHit> reference_hits(const Scene& scene, const std::vector<Ray>& rays) {
  std::vector<TracedHit> hits;
  for (const Ray& ray : rays) {
    const Hit hit = reference::closest_hit(ray, scene.spheres, scene.planes);
    hits.push_back({hit.t, hit.id, {}});
    if (hit.id == no_primitive) continue;
    const Surface surface = find_surface(scene.spheres, scene.planes, ray, hit);
    hits.back().normal = vec_cast<float>(surface.normal);
  }
  return hits;
}

Scene cloud_and_planes() {
  return objects(sphere_cloud(100), {{{0, -9, 0}, {0, 2, 0}}, {{0, 0, -12}, {0.1f, 0, -1}}});
}

Ray bounded(const Vec3d& org, const Vec3f& dir, float tmin, float tmax = inf) {
  Ray ray{org, dir};
  ray.tmin = tmin;
  ray.tmax = tmax;
  return ray;
}

class TracerIsa : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!select_kernels(GetParam())) GTEST_SKIP() << "this CPU lacks " << GetParam();
    options_.isa = GetParam();
  }
  TraceOptions options_;
};

std::vector<std::string> isa_names() {
  std::vector<std::string> names;
  for (const IsaInfo& one : list_isas()) names.emplace_back(one.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Isas, TracerIsa, testing::ValuesIn(isa_names()),
                         [](const auto& one) { return one.param; });

TEST_P(TracerIsa, HitsEqualTheScalarPath) {
  const Scene scene = cloud_and_planes();
  const std::vector<Ray> rays = ray_cloud(5003);
  const auto expected = reference_hits(scene, rays);
  for (const Solver solver : {Solver::robust, Solver::reference}) {
    options_.solver = solver;
    for (const unsigned threads : {1u, 2u, 7u}) {
      options_.threads = threads;
      EXPECT_EQ(differing_hits(closest(scene, rays, options_), expected), 0) << threads;
    }
  }
}

TEST_P(TracerIsa, AnyHitAgreesWithClosestHit) {
  const Scene scene = cloud_and_planes();
  const std::vector<Ray> rays = ray_cloud(5003);
  for (const Solver solver : solvers) {
    options_.solver = solver;
    Tracer tracer = make_tracer(scene, options_);
    const auto hits = closest(tracer, rays);
    const auto met = any(tracer, rays);
    int wrong = 0, count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const int expected = hits[i].id == no_primitive ? 0 : 1;
      wrong += met[i] == expected ? 0 : 1;
      count += expected;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(count, 1000);
    EXPECT_LT(count, 5000);
  }
}

/// Rays that pass a distant sphere's rim so closely that float cannot decide.
std::vector<Ray> rays_at_the_rim() {
  CaseRandom random(13);
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d away = random.direction();
    const Vec3d across = random.perpendicular(away);
    const Vec3f org = vec_cast<float>(away * 1000.0);
    const Vec3d rim = across * (1 + random.uniform(-1e-4, 1e-4));
    rays.push_back({vec_cast<double>(org), vec_cast<float>(rim - vec_cast<double>(org))});
  }
  return rays;
}

TEST_P(TracerIsa, TheSolverReachesTheKernels) {
  const Scene scene = objects({{{0, 0, 0}, 1}});
  const std::vector<Ray> rays = rays_at_the_rim();
  std::vector<std::uint8_t> met[2];
  for (const Solver solver : {Solver::fast, Solver::robust}) {
    options_.solver = solver;
    Tracer tracer = make_tracer(scene, options_);
    const auto hits = closest(tracer, rays);
    met[solver == Solver::fast ? 0 : 1] = any(tracer, rays);
    AlignedArray<std::uint8_t> expected(rays.size());
    HitBuffer expected_hits(rays.size());
    RayBuffer stream(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) stream.set(i, rays[i]);
    const Geometry geometry(scene.spheres, scene.planes);
    const KernelTable& kernels = *select_kernels(GetParam()).value();
    kernels.any_hit(geometry.view(), stream.view(), {solver}, expected.data());
    kernels.closest_hit(geometry.view(), stream.view(), {solver}, expected_hits.view());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_EQ(met[solver == Solver::fast ? 0 : 1][i], expected[i]) << i;
      EXPECT_EQ(hits[i].t, expected_hits.get(i).t) << i;
    }
  }
  EXPECT_NE(met[0], met[1]);
}

/// Rays that would hit, each with one number spoilt.
std::vector<Ray> spoilt_rays() {
  std::vector<Ray> rays;
  const Ray good{{0, 0, 5}, {0.01f, 0.02f, -1}};
  for (const float bad : {nan, -nan, inf, -inf}) {
    for (int i = 0; i < 6; ++i) {
      Ray ray = good;
      double* const org[] = {&ray.org.x, &ray.org.y, &ray.org.z};
      float* const dir[] = {&ray.dir.x, &ray.dir.y, &ray.dir.z};
      if (i < 3) *org[i] = static_cast<double>(bad);
      if (i >= 3) *dir[i - 3] = bad;
      rays.push_back(ray);
    }
  }
  for (const float bad : {nan, inf}) rays.push_back(bounded(good.org, good.dir, bad));
  for (const float bad : {nan, -inf}) rays.push_back(bounded(good.org, good.dir, 0, bad));
  rays.push_back({good.org, {0, 0, 0}});
  return rays;
}

TEST_P(TracerIsa, InvalidRaysMissAndHarmNoOthers) {
  const Scene scene = objects({{{0, 0, 0}, 1}}, {{{0, 0, -3}, {0, 0, 1}}});
  std::vector<Ray> rays;
  for (const Ray& bad : spoilt_rays()) {
    rays.push_back(bad);
    rays.push_back({{0, 0, 5}, {0, 0, -1}});
  }
  for (const Solver solver : solvers) {
    options_.solver = solver;
    Tracer tracer = make_tracer(scene, options_);
    const auto hits = closest(tracer, rays);
    const auto met = any(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const TracedHit expected = i % 2 == 0 ? TracedHit{} : TracedHit{4, 0, {0, 0, 1}};
      EXPECT_TRUE(same_bits(hits[i], expected)) << i << ": t " << hits[i].t << " id " << hits[i].id;
      EXPECT_EQ(met[i], i % 2) << i;
    }
  }
}

TEST(Tracer, NormalsAreTheViewsNormals) {
  const Scene scene = mixed_scene(64, 48);
  const PreparedScene prepared = prepare(scene, 64, 48).value();
  const KernelTable& kernels = *select_kernels("auto").value();
  SampleBuffer samples;
  samples.resize(64 * 48);
  for (int i = 0; i < 64 * 48; ++i) {
    samples.set(static_cast<std::size_t>(i), i % 64 + 0.5, i / 64 + 0.5);
  }
  RayBuffer stream(samples.size());
  kernels.primary_rays(prepared.camera_view, samples.view(), stream.view());
  std::vector<Aovs> aovs(samples.size());
  AovTracer(prepared, kernels, Solver::robust).trace(stream, prepared.coherence, aovs.data());
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < stream.size(); ++i) rays.push_back(stream.get(i));
  const auto hits = closest(scene, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(hits[i].normal, aovs[i].normal) << i;
    EXPECT_EQ(static_cast<std::uint32_t>(hits[i].id), aovs[i].id) << i;
  }
}

TEST(Tracer, UnitNormalsFaceTheRay) {
  const Scene scene = cloud_and_planes();
  const std::vector<Ray> rays = ray_cloud(20000);
  const auto hits = closest(scene, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3d normal = vec_cast<double>(hits[i].normal);
    if (hits[i].id == no_primitive) {
      EXPECT_EQ(hits[i].normal, Vec3f{}) << i;
      EXPECT_EQ(hits[i].t, double{inf}) << i;
      continue;
    }
    EXPECT_NEAR(length(normal), 1, 1e-7) << i;  // three roundings to float
    EXPECT_LE(dot(normal, normalize(vec_cast<double>(rays[i].dir))), 1e-7) << i;
  }
}

TEST(Tracer, BoundsChooseRootAndNormal) {
  const Scene scene = objects({{{0, 0, 0}, 1}});
  const auto hit = [&](double z, float tmin) {
    return closest(scene, bounded({0, 0, z}, {0, 0, -1}, tmin));
  };
  const auto is = [](const TracedHit& found, double t, float z) {
    return same_bits(found, {t, 0, {found.normal.x, found.normal.y, z}}) &&
           std::fabs(found.normal.x) + std::fabs(found.normal.y) == 0;
  };
  EXPECT_TRUE(is(hit(5, 0), 4, 1));        // from outside
  EXPECT_TRUE(is(hit(5, 4), 6, 1));        // the far side, as the first root is not in range
  EXPECT_TRUE(is(hit(0, 0), 1, 1));        // from inside
  EXPECT_TRUE(is(hit(0, -5), -1, 1));      // behind the origin, from outside
  EXPECT_TRUE(is(hit(-5, -9), -6, 1));     // both roots behind the origin
  EXPECT_TRUE(is(hit(-5, -5.5f), -4, 1));  // the second of these roots
  EXPECT_EQ(hit(-5, 0).id, no_primitive);
  EXPECT_EQ(hit(5, 6).id, no_primitive);  // t = tmin is not in range
}

TEST(Tracer, TiesGoToTheLowerId) {
  const Scene scene = objects({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}, {{9, 0, 0}, 1}},
                              {{{0, 0, 1}, {0, 0, 1}}, {{0, 0, -2}, {0, 0, 3}}});
  EXPECT_EQ(closest(scene, Ray{{0, 0, 5}, {0, 0, -1}}).id, 0);  // two spheres and a plane at t = 4
  EXPECT_EQ(closest(scene, Ray{{9, 0, 5}, {0, 0, -1}}).id, 2);
  EXPECT_EQ(closest(scene, Ray{{5, 0, 5}, {0, 0, -1}}).id, 3);
  EXPECT_EQ(closest(scene, Ray{{5, 0, 0}, {0, 0, -1}}).id, 4);
  const TracedHit back = closest(scene, Ray{{5, 0, -9}, {0, 0, 2}});
  EXPECT_EQ(back.id, 4);
  EXPECT_EQ(back.t, 3.5);
  EXPECT_EQ(back.normal.z, -1);
}

TEST(Tracer, PartitionsOfRaysDoNotMatter) {
  const Scene scene = cloud_and_planes();
  const std::vector<Ray> rays = ray_cloud(5003);
  Tracer tracer = make_tracer(scene);
  const auto whole = closest(tracer, rays);
  std::vector<TracedHit> parts(rays.size());
  const std::span<const Ray> all(rays);
  for (std::size_t first = 0, step = 1; first < rays.size(); first += step, step = step * 3 + 1) {
    const std::size_t count = std::min(step, rays.size() - first);
    EXPECT_TRUE(tracer.closest(all.subspan(first, count), std::span(parts).subspan(first, count)));
  }
  EXPECT_EQ(differing_hits(parts, whole), 0);
}

TEST(Tracer, NeedsNeitherCameraNorLightNorObjects) {
  const Scene unframed = objects({{{3e38f, 0, 0}, 3e38f}, {{-3e38f, 3e38f, 0}, 1e38f}});
  EXPECT_FALSE(prepare(unframed, 8, 8).ok());
  EXPECT_EQ(closest(unframed, Ray{{3e38f, 0, 0}, {1, 0, 0}}).id, 0);
  EXPECT_EQ(closest(objects({}), Ray{{0, 0, 0}, {1, 0, 0}}).id, no_primitive);
}

TEST(Tracer, ZeroRaysGiveZeroHits) {
  Tracer tracer = make_tracer(cloud_and_planes());
  EXPECT_TRUE(tracer.closest({}, {}));
  EXPECT_TRUE(tracer.any({}, {}));
  EXPECT_EQ(tracer.statistics().rays, 0u);
}

TEST(Tracer, TakesMovedScenes) {
  const Scene scene = cloud_and_planes();
  Tracer copying = make_tracer(scene);
  Tracer keeping = Tracer::create(Scene(scene)).value();
  const std::vector<Ray> rays = {{{0, 0, 9}, {0, 0, -1}}, {{0.5, 9, 0}, {0, -1, 0}}};
  const auto expected = closest(copying, rays), hits = closest(keeping, rays);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    EXPECT_EQ(hits[k].t, expected[k].t);
    EXPECT_EQ(hits[k].id, expected[k].id);
    EXPECT_EQ(hits[k].normal, expected[k].normal);
  }
}

TEST(Tracer, RefusesInvalidScenes) {
  Scene scene = cloud_and_planes();
  TraceOptions options;
  options.isa = "mmx";
  EXPECT_FALSE(Tracer::create(scene, options));
  scene.spheres[2].radius = -1;
  const auto tracer = Tracer::create(scene);
  ASSERT_FALSE(tracer);
  EXPECT_EQ(tracer.error().key, "sphere[2].radius");
}

TEST(Tracer, RefusesAnotherNumberOfResults) {
  Tracer tracer = make_tracer(cloud_and_planes());
  const std::vector<Ray> rays(3);
  std::vector<TracedHit> hits(2);
  std::vector<std::uint8_t> met(4);
  EXPECT_EQ(tracer.closest(rays, hits).error().message, "there are 3 rays, but room for 2 results");
  EXPECT_EQ(tracer.any(rays, met).error().message, "there are 3 rays, but room for 4 results");
}

TEST(Tracer, CancellingIsAnError) {
  std::atomic<bool> cancel{true};
  TraceOptions options;
  options.cancel = &cancel;
  Tracer tracer = make_tracer(cloud_and_planes(), options);
  const std::vector<Ray> rays = ray_cloud(5000);
  std::vector<TracedHit> hits(rays.size());
  std::vector<std::uint8_t> met(rays.size());
  ASSERT_FALSE(tracer.closest(rays, hits));
  EXPECT_EQ(tracer.any(rays, met).error().message, "tracing was cancelled");
  cancel = false;
  EXPECT_TRUE(tracer.closest(rays, hits));
}

TEST(Tracer, TellsItsProgressAndStatistics) {
  std::vector<Progress> told;
  TraceOptions options;
  options.threads = 1;
  options.isa = "scalar";
  options.progress = [&told](const Progress& progress) { told.push_back(progress); };
  Tracer tracer = make_tracer(cloud_and_planes(), options);
  EXPECT_GT(tracer.statistics().prepare_seconds, 0);
  closest(tracer, ray_cloud(5000));
  ASSERT_GE(told.size(), 5u);
  for (std::size_t i = 1; i < told.size(); ++i) EXPECT_GE(told[i].share, told[i - 1].share);
  EXPECT_LT(told.front().share, 0.5);
  EXPECT_EQ(told.back().share, 1);
  EXPECT_EQ(told.back().rays, 5000u);
  any(tracer, ray_cloud(100));
  const TraceStatistics statistics = tracer.statistics();
  EXPECT_EQ(statistics.rays, 5100u);
  EXPECT_GT(statistics.trace_seconds, 0);
  EXPECT_EQ(statistics.isa, "scalar");
  EXPECT_EQ(statistics.width, 1);
  EXPECT_EQ(statistics.threads, 1u);
}

TEST(Tracer, CanBeMoved) {
  Tracer first = make_tracer(cloud_and_planes());
  const std::vector<Ray> rays = ray_cloud(2000);
  const auto expected = closest(first, rays);
  Tracer second = std::move(first);
  EXPECT_EQ(differing_hits(closest(second, rays), expected), 0);
}

}  // namespace
}  // namespace boule::test::tracer
