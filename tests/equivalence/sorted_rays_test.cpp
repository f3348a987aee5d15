// Rays that are sorted by their directions. The answers are the scalar path's, in the places of
// their rays, whatever the length of the stream and the directions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/surface.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/placed_groups.h"

namespace boule::test {
namespace {

/// A cloud in which no two rays of a stream have the same answer for long, beside a ground sphere
/// that is in no leaf, and a plane.
struct CloudOnGround {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes{{{0, -1.4F, 0}, {0.1F, 1, 0}, 0}};

  CloudOnGround() {
    CaseRandom random(81);
    spheres = cube_of_spheres(random, 600, {}, 1, 0.1);
    spheres.push_back({{0, -101, 0}, 100, 0});
  }
  [[nodiscard]] std::vector<Hit> scalar_hits(const std::vector<Ray>& rays) const {
    std::vector<Hit> hits;
    hits.reserve(rays.size());
    for (const Ray& ray : rays) hits.push_back(reference::closest_hit(ray, spheres, planes));
    return hits;
  }
};

class SortedRaysOf : public OnEachIsa {
 protected:
  void SetUp() override {
    OnEachIsa::SetUp();
    ASSERT_GT(geometry.view().bvh.size, 0U);
  }
  /// The first `count` rays have the hits `expected`.
  void check(const std::vector<Ray>& rays, const std::vector<Hit>& expected,
             std::size_t count) const {
    const std::vector<Ray> first(rays.begin(), rays.begin() + static_cast<std::ptrdiff_t>(count));
    const auto hits = run_sorted(*kernels, geometry.view(), first);
    ASSERT_EQ(hits.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(same_bits(hits[i], expected[i]))
          << "ray " << i << " of " << count << ": " << hits[i].id << " " << hits[i].t
          << ", expected " << expected[i].id << " " << expected[i].t;
    }
  }

  const CloudOnGround scene;
  const Geometry geometry{scene.spheres, scene.planes};
};

constexpr float inf = std::numeric_limits<float>::infinity();
const float nan = std::nanf("");

/// Numbers that a direction may have, and that divide, round or compare in ways of their own.
constexpr float odd_numbers[] = {0, -0.0F, 1, -1, 1e-45F, -1e-40F, 1e30F, -3e38F, 1e-20F};

/// A ray as after a bounce: from the surface that another ray met, out of it or into it.
Ray bounced(CaseRandom& random, const CloudOnGround& scene) {
  for (;;) {
    const Vec3d from = random.direction() * random.uniform(0, 2);
    const Ray ray{from, vec_cast<float>(random.direction())};
    const Hit hit = reference::closest_hit(ray, scene.spheres, scene.planes);
    if (hit.id == no_primitive) continue;
    const Surface surface = find_surface(scene.spheres, scene.planes, ray, hit);
    const Vec3d direction = random.direction();
    const double outwards = dot(direction, surface.normal);
    return leave(surface, outwards > 0 ? Side::viewer : Side::beyond, direction);
  }
}

/// Rays after a bounce, among them such as a packet cannot take, as have no direction, or odd ones.
std::vector<Ray> bounced_rays(const CloudOnGround& scene, std::size_t count) {
  CaseRandom random(82);
  const auto odd = [&] { return odd_numbers[random.below(9)]; };
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    Ray ray = bounced(random, scene);
    if (i % 5 == 3) ray.tmax = static_cast<float>(random.uniform(0, 1));
    if (i % 7 == 1) ray = {ray.org, {odd(), odd(), odd()}};
    if (i % 11 == 4) ray.tmin = -2;
    if (i % 13 == 5) ray.tmax = 0;
    if (i % 17 == 6) ray.dir = {0, 0, 0};
    if (i % 19 == 7) (i % 2 == 0 ? ray.dir.x : ray.dir.z) = nan;
    if (i % 23 == 8) ray.org.x = 1e20;
    if (i % 29 == 9) (i % 2 == 0 ? ray.dir.y : ray.dir.z) = i % 3 == 0 ? inf : -inf;
    if (i % 31 == 10) ray.org.y = std::nan("");
    if (i % 37 == 11 && !ray.inside) ray.source = random.below(602);
    rays.push_back(ray);
  }
  return rays;
}

TEST_P(SortedRaysOf, AnyLengthEqualTheScalarPath) {
  const std::vector<Ray> rays = bounced_rays(scene, 1100);
  const std::vector<Hit> expected = scene.scalar_hits(rays);
  std::size_t met = 0, leaving = 0, inside = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    met += expected[i].id != no_primitive ? 1U : 0U;
    leaving += rays[i].source != no_primitive ? 1U : 0U;
    inside += rays[i].inside ? 1U : 0U;
  }
  EXPECT_GT(met, rays.size() / 3);
  EXPECT_LT(met, rays.size() * 9 / 10);
  EXPECT_GT(leaving, rays.size() / 2);
  EXPECT_GT(inside, rays.size() / 10);
  for (std::size_t count = 1; count <= rays.size(); ++count) {
    check(rays, expected, count);
    if (HasFatalFailure()) return;
  }
}

/// Streams of many pieces that are sorted, each to the places of its own.
TEST_P(SortedRaysOf, ManyPiecesKeepTheirPlaces) {
  const std::vector<Ray> rays = bounced_rays(scene, 5000);
  const std::vector<Hit> expected = scene.scalar_hits(rays);
  for (const std::size_t count : {1023U, 1024U, 1025U, 2047U, 2048U, 2049U, 4096U, 5000U})
    check(rays, expected, count);
}

/// All rays go into one cell, or into those at the ends and on the borders of a half.
TEST_P(SortedRaysOf, OneDirectionOrAlongAxes) {
  const std::vector<Vec3f> directions = {{1, 0, 0},      {-1, 0, 0},    {0, 1, 0},
                                         {0, -1, 0},     {0, 0, 1},     {0, 0, -1},
                                         {1, 1, 0},      {-1, 1, -1},   {1, -1, 1},
                                         {-0.0F, 0, -1}, {0, -0.0F, 0}, {3e38F, 3e38F, 3e38F},
                                         {nan, 1, 0},    {0, nan, 1},   {nan, nan, nan},
                                         {inf, 0, 0},    {0, 0, -inf},  {1e-45F, 0, -1e-45F}};
  std::vector<Ray> rays = bounced_rays(scene, 1100);
  for (const Vec3f& direction : directions) {
    SCOPED_TRACE(testing::Message() << direction.x << " " << direction.y << " " << direction.z);
    for (Ray& ray : rays) {
      ray.dir = direction;
      ray.inside = false;
    }
    check(rays, scene.scalar_hits(rays), rays.size());
    if (HasFatalFailure()) return;
  }
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].dir = directions[i % directions.size()];
  check(rays, scene.scalar_hits(rays), rays.size());
}

/// Rays that come in a stream in which they share what they have in common.
TEST_P(SortedRaysOf, StreamsThatShareNumbers) {
  for (const CommonPart common : {CommonPart::origin, CommonPart::direction}) {
    std::vector<Ray> rays = bounced_rays(scene, 1100);
    for (Ray& ray : rays) {
      const Vec3d org = ray.org;
      const Vec3f dir = ray.dir;
      ray = {{0.1, 0.9, 1.3}, {0.3F, -0.4F, -0.8F}};
      if (common == CommonPart::origin) ray.dir = dir;
      if (common == CommonPart::direction) ray.org = org;
    }
    const std::vector<Hit> expected = scene.scalar_hits(rays);
    Experience known = experience_of_sorting();
    RayBuffer stream = to_shared_stream(rays, common);
    HitBuffer hits(rays.size());
    kernels->closest_hit(geometry.view(), stream.view(),
                         {Solver::robust, Form::automatic, Coherence::none, &known}, hits.view());
    for (std::size_t i = 0; i < rays.size(); ++i)
      ASSERT_TRUE(same_bits(hits.get(i), expected[i])) << "ray " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, SortedRaysOf, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
