// Spheres that move, and single rays.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "render/renderer/tracer.h"
#include "tests/render/ray_clouds.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::tracer_update {
namespace {

std::vector<TracedHit> closest(Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<TracedHit> hits(rays.size());
  EXPECT_TRUE(tracer.closest(rays, hits));
  return hits;
}

std::vector<Sphere> moved(std::vector<Sphere> spheres, double by) {
  CaseRandom random(3);
  for (Sphere& sphere : spheres) {
    const Vec3d step = random.direction();
    sphere.center = vec_cast<float>(vec_cast<double>(sphere.center) + step * by);
  }
  return spheres;
}

/// Hits of a tracer that was updated, and of a new one.
void expect_updated(Tracer& tracer, Scene scene, const std::vector<Sphere>& spheres) {
  const Status done = tracer.update(spheres);
  ASSERT_TRUE(done) << done.error().message;
  scene.spheres = spheres;
  Tracer fresh = Tracer::create(scene).value();
  const std::vector<Ray> rays = ray_cloud(3000);
  EXPECT_EQ(differing_hits(closest(tracer, rays), closest(fresh, rays)), 0);
  std::vector<double> lengths(rays.size()), expected(rays.size());
  ASSERT_TRUE(tracer.chord(rays, lengths));
  ASSERT_TRUE(fresh.chord(rays, expected));
  EXPECT_EQ(lengths, expected);
}

TEST(TracerUpdate, HitsAreThoseOfANewTracer) {
  for (const int count : {1, 3, 100, 5000}) {
    Scene scene = objects(sphere_cloud(count), {{{0, -9, 0}, {0, 2, 0}}});
    scene.capsules = {{{1, 2, 3}, {-4, 0, 2}, 0.5f}};
    Tracer tracer = Tracer::create(scene).value();
    for (const double by : {0.0, 0.01, 1.0, 30.0, 0.1})
      expect_updated(tracer, scene, moved(scene.spheres, by));
  }
}

TEST(TracerUpdate, CopiesAndHugeSpheresMayCome) {
  const Scene scene = objects(sphere_cloud(2000));
  Tracer tracer = Tracer::create(scene).value();
  std::vector<Sphere> piled = scene.spheres, huge = scene.spheres;
  for (std::size_t k = 0; k < 50; ++k) piled[100 + k] = piled[100];
  huge[7].radius = 1e25f;
  huge[9].center.y = 1e30f;
  for (const auto& spheres : {piled, scene.spheres, huge, piled})
    expect_updated(tracer, scene, spheres);
}

TEST(TracerUpdate, TellsItsSpheres) {
  std::vector<Sphere> spheres = sphere_cloud(2000);
  for (std::size_t k = 0; k < 50; ++k) spheres[100 + k] = spheres[100];
  Tracer tracer = Tracer::create(objects(spheres)).value();
  for (const double by : {0.0, 0.5}) {
    const std::vector<Sphere> there = moved(spheres, by);
    ASSERT_TRUE(tracer.update(there));
    const std::vector<Sphere> told = tracer.spheres();
    ASSERT_EQ(told.size(), there.size());
    for (std::size_t k = 0; k < told.size(); ++k) {
      EXPECT_EQ(told[k].center, there[k].center) << k;
      EXPECT_EQ(told[k].radius, there[k].radius) << k;
    }
  }
}

TEST(TracerUpdate, WrongSpheresMoveNothing) {
  const Scene scene = objects(sphere_cloud(200));
  Tracer tracer = Tracer::create(scene).value();
  std::vector<Sphere> few = scene.spheres, wrong = moved(scene.spheres, 1);
  few.pop_back();
  wrong[17].radius = 0;
  EXPECT_EQ(tracer.update(few).error().key, "spheres");
  EXPECT_NE(tracer.update(wrong).error().message.find("sphere 17: radius"), std::string::npos);
  wrong[17].center.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(tracer.update(wrong));
  expect_updated(tracer, scene, scene.spheres);
}

/// As many instances as share their group.
TEST(TracerUpdate, SharedGroupsAreRefused) {
  Scene scene = objects({});
  scene.groups = {{"many", sphere_cloud(2000), {}, {}}};
  for (int i = 0; i < 100; ++i)
    scene.instances.push_back({0, {static_cast<float>(30 * i), 0, 0}, {}, 1, {}});
  Tracer tracer = Tracer::create(scene).value();
  EXPECT_FALSE(tracer.update(sphere_cloud(200'000)));
  EXPECT_TRUE(tracer.spheres().empty());
}

TEST(SingleRay, HitsAreThoseOfStreams) {
  for (const Solver solver : {Solver::fast, Solver::robust, Solver::reference}) {
    for (const int count : {0, 5, 3000}) {
      const Scene scene = objects(sphere_cloud(count), {{{0, -9, 0}, {0, 2, 0}}});
      Tracer tracer = Tracer::create(scene, {.solver = solver}).value();
      std::vector<Ray> rays = ray_cloud(500);
      rays[3].tmin = 1e-300;
      rays[4].dir = {};
      rays[5].tmin = -2;
      rays[6].org.x = 1e30;
      for (std::size_t k = 10; k < 200; ++k) rays[k].tmax = 0.1 * static_cast<double>(k);
      const std::vector<TracedHit> expected = closest(tracer, rays);
      std::vector<std::uint8_t> met(rays.size());
      ASSERT_TRUE(tracer.any(rays, met));
      std::vector<TracedHit> hits;
      std::size_t other_answers = 0;
      for (std::size_t k = 0; k < rays.size(); ++k) {
        hits.push_back(tracer.closest(rays[k]).value());
        other_answers += tracer.any(rays[k]).value() != (met[k] != 0) ? 1 : 0;
      }
      EXPECT_EQ(differing_hits(hits, expected), 0);
      EXPECT_EQ(other_answers, 0U);
      for (std::size_t k = 0; k < rays.size(); ++k)
        EXPECT_EQ(hits[k].entering, expected[k].entering) << k;
    }
  }
}

/// Rays whose ends lie around those of hits, and rays that leave spheres.
std::vector<Ray> ending_rays(Tracer& tracer) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<Ray> rays = ray_cloud(1000);
  for (Ray& ray : rays) ray.tmin = 0;
  const std::vector<TracedHit> hits = closest(tracer, rays);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    Ray& ray = rays[k];
    const double t = hits[k].id == no_primitive ? 1 : hits[k].t;
    switch (k % 8) {
      case 0:
        ray.tmin = t;
        break;
      case 1:
        ray.tmin = std::nextafter(t, 0.0);
        break;
      case 2:
        ray.tmax = t;
        break;
      case 3:
        ray.tmax = std::nextafter(t, 0.0);
        break;
      case 4:
        ray.tmax = std::nextafter(t, inf);
        break;
      case 5:
        ray.tmin = k % 16 == 5 ? 5e-324 : -5e-324;
        break;
      default:
        ray.org = ray.org + vec_cast<double>(ray.dir) * t;
        ray.source = hits[k].id;
        ray.inside = k % 8 == 6;
    }
  }
  rays[7].tmax = 1e-300;
  rays[15].tmin = std::numeric_limits<double>::quiet_NaN();
  rays[23].tmax = std::numeric_limits<double>::quiet_NaN();
  return rays;
}

TEST(SingleRay, EndsAreComparedInDouble) {
  Scene scene = objects(sphere_cloud(3000));
  scene.spheres.push_back({{0, -2000, 0}, 1990});  // outside the tree
  for (const std::string& isa : all_isa_names()) {
    if (kernels_or_null(isa) == nullptr) continue;
    Tracer tracer = Tracer::create(scene, {.isa = isa}).value();
    const std::vector<Ray> rays = ending_rays(tracer);
    const std::vector<TracedHit> expected = closest(tracer, rays);
    std::vector<TracedHit> hits;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      hits.push_back(tracer.closest(rays[k]).value());
      EXPECT_EQ(hits[k].entering, expected[k].entering) << isa << k;
      EXPECT_EQ(tracer.any(rays[k]).value(), expected[k].id != no_primitive) << isa << k;
    }
    EXPECT_EQ(differing_hits(hits, expected), 0) << isa;
  }
}

TEST(SingleRay, ATracerMovedAwayHasNone) {
  Tracer tracer = Tracer::create(objects(sphere_cloud(5))).value();
  const Tracer other = std::move(tracer);
  EXPECT_FALSE(tracer.closest(Ray{{0, 0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(tracer.any(Ray{{0, 0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(tracer.update({}));
}

}  // namespace
}  // namespace boule::test::tracer_update
