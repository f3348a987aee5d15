// Scenes in which packets or single rays would lose hits without a certain bound of filter_bounds.h
// (mutations.sh takes them away one by one). For bounds that are not here hard cases show it.
#include <array>
#include <cmath>

#include "core/math/geometry.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::bounds {
namespace {

class Bounds : public OnEachIsa {
 protected:
  void check(const std::vector<Sphere>& spheres, const std::vector<Ray>& rays,
             const std::vector<Query>& queries) {
    std::vector<Hit> expected;
    for (const Ray& ray : rays) expected.push_back(reference::closest_hit(ray, spheres, {}));
    for (const Hit& hit : expected) met += hit.id < 0 ? 0U : 1U;
    all += rays.size();
    for (const Structure structure : {Structure::scan, Structure::bvh}) {
      const Geometry geometry(spheres, {}, structure);
      for (const Query& query : queries) {
        SCOPED_TRACE(testing::Message() << "structure " << static_cast<int>(structure) << " form "
                                        << static_cast<int>(query.form) << " common "
                                        << static_cast<int>(query.coherence));
        const auto hits = run_closest(*kernels, geometry.view(), rays, query);
        const auto occluded = run_any(*kernels, geometry.view(), rays, query);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          ASSERT_TRUE(same_bits(hits[i], expected[i]))
              << "ray " << i << ": " << hits[i].id << " " << hits[i].t << ", expected "
              << expected[i].id << " " << expected[i].t;
          ASSERT_EQ(occluded[i], expected[i].id < 0 ? 0 : 1) << "ray " << i;
        }
      }
    }
  }

  std::size_t all = 0, met = 0;
};

const Query packets{Solver::robust, Form::packet, Coherence::none};
const Query singles{Solver::robust, Form::single, Coherence::none};
const Query flights{Solver::robust, Form::flight, Coherence::none};
const Query sets{Solver::robust, Form::set, Coherence::none};

/// squared_floor: spheres so small that the squares of their radii are a few steps of the smallest
/// floats, met close to the rim.
TEST_P(Bounds, SpheresWhoseSquaresUnderflow) {
  CaseRandom random(91);
  for (int trial = 0; trial < 200; ++trial) {
    const double r = random.decade(-23, -19), away = r * random.uniform(1.2, 5);
    const Sphere sphere{vec_cast<float>(random.direction() * away), static_cast<float>(r), 0};
    const Vec3d center = vec_cast<double>(sphere.center);
    const double distance = length(center), radius = sphere.radius;
    std::vector<Ray> rays;
    for (int i = 0; i < 32; ++i) {
      const double sine = radius / distance * (1 + random.sign() * random.decade(-9, -3));
      const Vec3d towards = center * (1 / distance), side = random.perpendicular(towards);
      rays.push_back(
          {{0, 0, 0}, vec_cast<float>(towards * std::sqrt(1 - sine * sine) + side * sine)});
    }
    check({sphere}, rays, {packets, singles, flights, sets});
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 3 / 4);
}

/// box_step: a million units from the world's origin, where a float step is 1/8, rays pass spheres
/// close to where they touch the sides of their boxes. They are a little oblique: along an axis an
/// origin is rounded as the side is.
TEST_P(Bounds, BoxSidesFarFromTheOrigin) {
  CaseRandom random(92);
  const std::array axes = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  for (int trial = 0; trial < 40; ++trial) {
    const Vec3d middle = random.direction() * 2e6;
    std::vector<Sphere> spheres;
    for (int i = 0; i < 100; ++i)
      spheres.push_back({vec_cast<float>(middle + random.direction() * random.uniform(0, 5)),
                         static_cast<float>(random.uniform(0.1, 0.4)), 0});
    std::vector<Ray> rays;
    for (const Sphere& sphere : spheres) {
      const int along = random.below(3), across = (along + 1 + random.below(2)) % 3;
      const double reach = double{sphere.radius} * (1 - random.decade(-3, -0.5));
      const Vec3d point = vec_cast<double>(sphere.center) +
                          axes[static_cast<std::size_t>(across)] * (random.sign() * reach);
      const Vec3d axis = axes[static_cast<std::size_t>(along)] * random.sign();
      const Vec3d towards = axis + random.direction() * random.decade(-4, -2);
      const Vec3d org = point - towards * random.uniform(0.5, 3);
      const Vec3f rounded = vec_cast<float>(org);
      rays.push_back(
          {random.chance(0.5) ? org : vec_cast<double>(rounded), vec_cast<float>(towards)});
    }
    check(spheres, rays, {packets, singles, flights, sets});
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 2);
  EXPECT_LT(met, all);
}

/// A float at or beyond t, or one before it.
float end_near(double t, bool beyond) {
  auto end = static_cast<float>(t);
  if (beyond && double{end} < t) end = std::nextafter(end, 2 * end);
  if (!beyond && double{end} >= t) end = std::nextafter(end, 0.0F);
  return end;
}

/// reach: sixteen rays come from far away and end where they touch the pole of a small sphere near
/// the world's origin, or a float step before. They mirror each other, so that rounding moves their
/// ends the same way. Along one axis alone they go the same way, and spheres that are as far away
/// as they come from make them count as short.
TEST_P(Bounds, EndsOfShortRays) {
  CaseRandom random(93);
  const std::array axes = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<Sphere> spheres;
    std::vector<Ray> rays;
    for (int i = 0; i < 40; ++i)
      spheres.push_back({vec_cast<float>(Vec3d{-2000, 0, 0} + random.direction() * 5.0), 0.1F, 0});
    for (std::size_t k = 0; k < 6; ++k) {
      const Vec3d along = axes[k / 2] * (k % 2 == 0 ? 1.0 : -1.0);
      const double radius = random.uniform(0.001, 0.005);
      spheres.push_back(
          {vec_cast<float>(along * random.uniform(0.01, 0.02)), static_cast<float>(radius), 0});
    }
    for (std::size_t k = 0; k < 6; ++k) {
      const Sphere& sphere = spheres[40 + k];
      const Vec3d center = vec_cast<double>(sphere.center), along = normalize(center);
      const Vec3d pole = center + along * double{sphere.radius};
      const double away = random.uniform(200, 700), aside = random.uniform(0.1, 1);
      for (int i = 0; i < 16; ++i) {
        const Vec3d org = along * away + axes[(k / 2 + 1) % 3] * ((i & 1) == 0 ? aside : -aside) +
                          axes[(k / 2 + 2) % 3] * ((i & 2) == 0 ? aside : -aside);
        Ray ray{vec_cast<double>(vec_cast<float>(org)), vec_cast<float>(pole - org)};
        ray.tmax = end_near(reference::closest_hit(ray, spheres, {}).t, i % 4 != 0);
        rays.push_back(ray);
      }
    }
    check(spheres, rays, {packets, singles, flights, sets});
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 2);
  EXPECT_LT(met, all);
}

INSTANTIATE_TEST_SUITE_P(Tables, Bounds, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::bounds
