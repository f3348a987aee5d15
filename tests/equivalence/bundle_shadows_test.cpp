// Shadow rays that share an end or a direction, in tiles and scattered: the bundle finds the
// occlusion that the scalar path finds.
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/equivalence/bundle_tiles.h"

namespace boule::test {
namespace {

/// Rays from what the tile's rays hit, moved off it, towards a light: a point, or a direction.
std::vector<Ray> towards_light(const BundleScene& scene, const std::vector<Ray>& tile,
                               const Vec3d& light, bool is_point) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < tile.size(); ++i) {
    const Hit hit = reference::closest_hit(tile[i], scene.spheres, {});
    if (hit.id < 0) continue;
    const Sphere& sphere = scene.spheres[static_cast<std::size_t>(hit.id)];
    const Vec3d point = tile[i].org + vec_cast<double>(tile[i].dir) * hit.t;
    const Vec3d normal = normalize(point - center_of(sphere));
    const double moved = 0x1p-48 * (length(point) + length(point - center_of(sphere)));
    Ray ray{point + normal * moved, vec_cast<float>(light)};
    if (is_point) {
      ray.dir = vec_cast<float>(light - ray.org);
      ray.tmax = 1 - 0x1p-22F;
    }
    ray.source = hit.id;
    ray.inside = i % 37 == 0;
    rays.push_back(ray);
  }
  return rays;
}

TEST_P(Bundle, FindsShadows) {
  for (const BundleScene& scene : bundle_scenes()) {
    const Geometry geometry(scene.spheres, {});
    CaseRandom random(66);
    std::size_t rays = 0;
    met = 0;
    for (int k = 0; k < 40; ++k) {
      const Tile tile = random_tile(random, scene);
      if (!judgeable(tile)) continue;
      const std::vector<Ray> camera_rays = from_one_origin(tile, scene.eye);
      // Near the eye, behind the spheres, among them; or where a sphere's rim is in the way.
      const double away = length(tile.middle - scene.eye) * random.decade(-2, 2);
      const Vec3d from = random.chance(0.5) ? scene.eye : tile.middle;
      Vec3d light = from + random.direction() * away;
      const Tile other = random_tile(random, scene);
      const double beyond = 1 + random.decade(-3, 1);
      if (random.chance(0.6) && judgeable(other))
        light = tile.middle + (other.middle - tile.middle) * beyond;
      for (const bool is_point : {true, false}) {
        const Vec3d to = is_point ? light : light - tile.middle;
        const auto shadow_rays = towards_light(scene, camera_rays, to, is_point);
        const Coherence coherence = is_point ? Coherence::common_end : Coherence::common_direction;
        SCOPED_TRACE(testing::Message() << "tile " << k << (is_point ? " to a point" : ""));
        check_any(scene, geometry, shadow_rays, coherence);
        if (HasFatalFailure()) return;
        rays += shadow_rays.size();
      }
    }
    EXPECT_GT(met, rays / 20) << scene.name;
    EXPECT_LT(met, rays * 19 / 20) << scene.name;
    EXPECT_GT(rays, 1000U) << scene.name;
  }
}

/// Rays from anywhere and from spheres, towards one point or in one direction.
std::vector<Ray> scattered(CaseRandom& random, const std::vector<Sphere>& spheres,
                           std::size_t count, const Vec3d& light, bool is_point) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    Ray ray{{x, y, z}, vec_cast<float>(light)};
    if (random.chance(0.3)) {
      ray.source = random.below(static_cast<int>(spheres.size()));
      ray.inside = random.chance(0.5);
      const Sphere& sphere = spheres[static_cast<std::size_t>(ray.source)];
      const double off = ray.inside ? -0x1p-46 : 0x1p-46;
      ray.org = center_of(sphere) + random.direction() * (double{sphere.radius} * (1 + off));
    }
    if (is_point) {
      ray.dir = vec_cast<float>(light - ray.org);
      ray.tmax = 1 - 0x1p-22F;
    }
    if (random.chance(0.01)) ray.tmax = static_cast<float>(random.uniform(0, 1));
    rays.push_back(ray);
  }
  return rays;
}

/// Rays that have little in common with their neighbours in the stream: they are sorted, a pool at
/// a time. Among many spheres there are few rays for each sphere.
TEST_P(Bundle, SortsShadowRays) {
  for (const auto& [spheres, count] : {std::pair{300, 66000}, std::pair{4000, 5000}}) {
    CaseRandom random(67);
    BundleScene scene = cloud("scattered", {0, 0, 0}, 1, 0.1, 0);
    while (scene.spheres.size() < static_cast<std::size_t>(spheres)) {
      const Vec3d center = random.direction() * random.uniform(0, 1);
      scene.spheres.push_back(
          {vec_cast<float>(center), static_cast<float>(random.decade(-2.5, -1.3)), 0});
    }
    for (const auto& [light, is_point] :
         {std::pair{Vec3d{0.1, 0.2, -0.3}, true}, std::pair{Vec3d{5, 9, 2}, true},
          std::pair{Vec3d{1, -2, 0.3}, false}}) {
      if (is_point) scene.planes = {{{0, -0.8F, 0}, {0.1F, 1, 0}, 0}};
      if (!is_point) scene.planes.clear();  // all would meet it
      const Geometry geometry(scene.spheres, scene.planes);
      const auto rays =
          scattered(random, scene.spheres, static_cast<std::size_t>(count), light, is_point);
      const Coherence coherence = is_point ? Coherence::common_end : Coherence::common_direction;
      SCOPED_TRACE(testing::Message() << spheres << " spheres" << (is_point ? ", to a point" : ""));
      met = 0;
      check_any(scene, geometry, rays, coherence);
      if (HasFatalFailure()) return;
      EXPECT_GT(met, rays.size() / 10);
      EXPECT_LT(met, rays.size() * 9 / 10);
    }
  }
}

/// Whatever earlier streams found out about sorting, and whatever the clock says of this one.
TEST_P(Bundle, ShadowsDependOnNoFindings) {
  CaseRandom random(68);
  BundleScene scene = cloud("scattered", {0, 0, 0}, 1, 0.1, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d center = random.direction() * random.uniform(0, 1);
    scene.spheres.push_back({vec_cast<float>(center), 0.02F, 0});
  }
  const Geometry geometry(scene.spheres, {});
  const std::vector<Ray> rays = scattered(random, scene.spheres, 9000, {0.1, 0.2, -0.3}, true);
  const auto expected =
      run_any(*kernels, geometry.view(), rays, {Solver::robust, Form::packet, Coherence::none});
  constexpr float limitless = std::numeric_limits<float>::max();
  for (const float most : {0.0F, 1e-3F, limitless, std::nanf("")}) {
    for (const std::uint32_t pays : {0U, 1U, 2U}) {
      for (const std::uint32_t left : {0U, 1U, 1000000U}) {
        Experience known;
        known.sorting = {most, pays, 3, left};
        const auto occluded =
            run_any(*kernels, geometry.view(), rays,
                    {Solver::robust, Form::automatic, Coherence::common_end, &known});
        ASSERT_EQ(occluded, expected) << most << ' ' << pays << ' ' << left;
        if (left > 1) EXPECT_LT(known.sorting.left, left);
        if (left == 0) EXPECT_LT(known.sorting.pays, 2U);  // there was a trial
      }
    }
  }
}

/// Rays that are said to have one end and have none: they are not sorted.
TEST_P(Bundle, BrokenPromisesAreNotSorted) {
  CaseRandom random(69);
  BundleScene scene = cloud("scattered", {0, 0, 0}, 1, 0.1, 0);
  const Geometry geometry(scene.spheres, {});
  std::vector<Ray> rays;
  for (int i = 0; i < 3000; ++i) {
    const Vec3d end = random.direction();
    rays.push_back(scattered(random, scene.spheres, 1, end, true)[0]);
  }
  Experience known;
  const Query query{Solver::robust, Form::automatic, Coherence::common_end, &known};
  EXPECT_EQ(
      run_any(*kernels, geometry.view(), rays, query),
      run_any(*kernels, geometry.view(), rays, {Solver::robust, Form::packet, Coherence::none}));
  EXPECT_EQ(known.sorting.pays, 0U);
  EXPECT_GT(known.sorting.left, 0U);
}

/// Rays that go on beyond the end that they have in common.
TEST_P(Bundle, GoesOnBeyondTheEnd) {
  const BundleScene scene = cloud("around a light", {0, 0, 0}, 1, 0.1, 0);
  const Geometry geometry(scene.spheres, {});
  const Vec3d light{0.1, 0.2, 0.5};
  std::vector<Ray> rays;
  for (int i = 0; i < 1024; ++i) {
    const Vec3d org{0.01 * even_bits(i), 0.01 * even_bits(i >> 1), 3};
    rays.push_back({org, vec_cast<float>(light - org)});
  }
  for (const float tmax :
       {1.0F, 1 + 0x1p-23F, 1.5F, 1e30F, std::numeric_limits<float>::infinity()}) {
    for (Ray& ray : rays) ray.tmax = tmax;
    check_any(scene, geometry, rays, Coherence::common_end);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace boule::test
