// Scenes large enough for a tree, and hard for its boxes: the answers are the scalar path's.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::tree {
namespace {

struct TreeScene {
  std::string name;
  std::vector<Sphere> spheres;
  std::vector<Ray> rays;
};

Vec3f float_point(CaseRandom& random, const Vec3d& center, double spread) {
  const double x = random.uniform(-spread, spread);
  const double y = random.uniform(-spread, spread);
  const double z = random.uniform(-spread, spread);
  return vec_cast<float>(center + Vec3d{x, y, z});
}

/// Mostly towards the rim of a sphere, where a box that is too small would show.
Ray at_rim(CaseRandom& random, const Sphere& sphere, const Vec3d& org) {
  const Vec3d center = vec_cast<double>(sphere.center);
  const Vec3d view = normalize(center - org);
  const double beta = 1 - random.decade(-7, 0);
  const Vec3d target = center + random.perpendicular(view) * (beta * double{sphere.radius});
  return {org, vec_cast<float>(target - org)};
}

TreeScene cloud(const std::string& name, const Vec3d& center, double spread, double radius,
                double distance) {
  CaseRandom random(51);
  TreeScene scene{name, {}, {}};
  for (int i = 0; i < 700; ++i) {
    const Vec3f at = float_point(random, center, spread);
    scene.spheres.push_back({at, static_cast<float>(radius * random.uniform(0.2, 1)), 0});
  }
  for (int i = 0; i < 900; ++i) {
    const Vec3d eye = vec_cast<double>(float_point(random, center + Vec3d{0, 0, distance}, spread));
    const auto k = static_cast<std::size_t>(random.below(700));
    Ray ray = at_rim(random, scene.spheres[k], eye);
    if (i % 5 == 0) ray.dir = vec_cast<float>(random.direction());
    if (i % 7 == 0) ray.org = ray.org + random.direction() * (0.3 * radius);  // no float
    if (i % 11 == 0) ray.tmin = -1;
    if (i % 13 == 0) ray.tmax = static_cast<float>(random.uniform(0, 2));
    scene.rays.push_back(ray);
  }
  return scene;
}

/// Spheres of radius 0.5 on whole numbers, and rays along the axes that touch them exactly, run in
/// the faces of their boxes and meet many at the same t.
TreeScene lattice() {
  TreeScene scene{"lattice", {}, {}};
  for (int i = 0; i < 512; ++i)
    scene.spheres.push_back(
        {{static_cast<float>(i % 8), static_cast<float>(i / 8 % 8), static_cast<float>(i / 64)},
         0.5F,
         0});
  CaseRandom random(52);
  for (int i = 0; i < 900; ++i) {
    const int axis = i % 3;
    float at[3];
    for (float& x : at) x = static_cast<float>(random.below(17) - 1) * 0.5F;
    Vec3f dir{0, 0, 0};
    const auto along = static_cast<float>(random.sign());
    (axis == 0 ? dir.x : axis == 1 ? dir.y : dir.z) = along;
    if (i % 2 == 0) at[axis] = -20 * along;
    if (i % 4 == 1) (axis == 0 ? dir.y : axis == 1 ? dir.z : dir.x) = along;  // diagonal
    scene.rays.push_back({vec_cast<double>(Vec3f{at[0], at[1], at[2]}), dir});
  }
  return scene;
}

/// Rays that begin just within a sphere, at right angles to the direction from its centre: f.d is
/// next to 0, so that the reject depends on whether f.f is greater than r^2.
TreeScene skimming() {
  TreeScene scene{"skimming", {}, {}};
  CaseRandom random(56);
  for (int i = 0; i < 343; ++i) {
    const Vec3f at = float_point(random, {0, 0, 0}, 0.1);
    scene.spheres.push_back({at, static_cast<float>(random.uniform(0.5, 1)), 0});
  }
  for (int i = 0; i < 1800; ++i) {
    const Sphere& sphere = scene.spheres[static_cast<std::size_t>(i % 343)];
    const Vec3d out = random.direction();
    const double depth = std::exp2(-20.0 - i % 8);
    const Vec3d org = vec_cast<double>(sphere.center) + out * (double{sphere.radius} * (1 - depth));
    const Vec3f dir = vec_cast<float>(random.perpendicular(out));
    scene.rays.push_back({vec_cast<double>(vec_cast<float>(org)), dir});
  }
  return scene;
}

TreeScene on_the_ground() {
  TreeScene scene = cloud("ground of 1e6", {0, 1, 0}, 3, 0.2, 4);
  scene.spheres[5] = {{0, -1e6F, 0}, 1e6F, 0};
  return scene;
}

TreeScene copies() {
  TreeScene scene = cloud("copies", {0, 0, 0}, 1, 0.3, 3);
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) scene.spheres[i] = scene.spheres[i % 20];
  return scene;
}

/// Twenty spheres with 35 copies each. A leaf's box is then the box of one sphere, and a ray that
/// touches the sphere where that touches its box shows every mistake of a box test.
TreeScene tight_boxes(const std::string& name, const Vec3d& center, double spread, double radius) {
  TreeScene scene{name, {}, {}};
  CaseRandom random(53);
  for (int i = 0; i < 20; ++i)
    scene.spheres.push_back({float_point(random, center, spread), static_cast<float>(radius), 0});
  for (std::size_t i = 20; i < 700; ++i) scene.spheres.push_back(scene.spheres[i % 20]);
  return scene;
}

/// Origins that float rounds by half a radius: a box must grow by that.
TreeScene between_floats() {
  TreeScene scene = tight_boxes("origins between floats", {1e7, -1e7, 1e7}, 100, 1);
  CaseRandom random(54);
  for (std::size_t i = 0; i < 600; ++i) {
    const double beta = 1 - random.decade(-3, 0);
    const double along = random.sign() * 20, beside = random.sign() * beta;
    Vec3d from{along, beside, 0};
    if (i % 3 == 1) from = {beside, 0, along};
    if (i % 3 == 2) from = {0, along, beside};
    const Vec3d to = i % 3 == 0   ? Vec3d{-along, 0, 0}
                     : i % 3 == 1 ? Vec3d{0, 0, -along}
                                  : Vec3d{0, -along, 0};
    scene.rays.push_back(
        {vec_cast<double>(scene.spheres[i % 20].center) + from, vec_cast<float>(to)});
  }
  return scene;
}

/// A row of specks, F / r = 1e8, and rays nearly along it. A ray enters the box of the first speck
/// it meets through a side, just before it leaves by the far end, so that only rounding decides.
TreeScene row_of_specks() {
  constexpr double r = 4e-8;
  TreeScene scene{"a row of specks, F / r = 1e8", {}, {}};
  for (int i = 0; i < 700; ++i)
    scene.spheres.push_back({{0, 0, static_cast<float>(i % 20) * 1e-3F}, static_cast<float>(r), 0});
  CaseRandom random(55);
  for (int i = 0; i < 2000; ++i) {
    const double side = random.sign(), beta = 1 - random.decade(-6, -3);
    const double slope = side * elementary::pow(2, random.uniform(-22, -18));
    const double z = random.below(20) * 1e-3;
    const Vec3d org{-side * beta * r - (4 + z) * slope, 0, -4};
    scene.rays.push_back(
        {vec_cast<double>(vec_cast<float>(org)), vec_cast<float>(Vec3d{slope, 0, 1})});
  }
  return scene;
}

/// Specks beside the axes, at slopes too small for a reciprocal that stays finite.
TreeScene nearly_along_axes() {
  TreeScene scene{"rays nearly along an axis", {}, {}};
  CaseRandom random(58);
  for (int i = 0; i < 600; ++i) {
    const double along = random.sign() * random.uniform(500, 1000);
    const auto slope = [&] { return random.sign() * elementary::pow(2, random.uniform(-66, -58)); };
    const double beside = slope(), above = i % 4 == 0 ? 0 : slope();
    Vec3d dir{beside, above, 1};
    if (i % 3 == 1) dir = {1, beside, above};
    if (i % 3 == 2) dir = {above, 1, beside};
    const Vec3f center = vec_cast<float>(dir * along);
    scene.spheres.push_back({center, static_cast<float>(1000 * 0x1p-70), 0});
    scene.rays.push_back({{0, 0, 0}, vec_cast<float>(dir * (along < 0 ? -1.0 : 1.0))});
  }
  return scene;
}

/// Rays pass through the sphere that they are said to leave, wherever it is.
TreeScene sources_ahead() {
  TreeScene scene = cloud("sources ahead", {0, 0, 0}, 1, 0.3, 3);
  for (Ray& ray : scene.rays) ray.source = reference::closest_hit(ray, scene.spheres, {}).id;
  return scene;
}

/// Where more copies lie together than a leaf holds, most are left out of the tree. Rays that leave
/// any of them, and pass through it all the same, have the hits that they have with all.
TreeScene sources_among_copies() {
  TreeScene scene = cloud("sources among copies", {0, 0, 0}, 1, 0.3, 3);
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) scene.spheres[i] = scene.spheres[i % 20];
  CaseRandom random(71);
  for (Ray& ray : scene.rays) {
    const std::int32_t hit = reference::closest_hit(ray, scene.spheres, {}).id;
    if (hit >= 0) ray.source = hit % 20 + 20 * random.below(4);
  }
  return scene;
}

TreeScene beyond_the_filter() {
  TreeScene scene = cloud("rays and spheres that float cannot judge", {0, 0, 0}, 1, 0.1, 3);
  for (std::size_t i = 0; i < 20; ++i) scene.spheres[i].center.x *= 1e19F;
  for (std::size_t i = 0; i < 60; ++i) scene.rays[i].org.z = 1e19;
  for (std::size_t i = 60; i < 90; ++i) scene.rays[i].dir = {0, 0, 0};
  for (std::size_t i = 90; i < 120; ++i) scene.rays[i].dir.y = std::nanf("");
  for (std::size_t i = 120; i < 300; ++i) scene.rays[i].dir.x *= 1e-42F;
  return scene;
}

std::vector<TreeScene> scenes() {
  return {cloud("inside", {0, 0, 0}, 1, 0.1, 0),
          cloud("outside", {0, 0, 0}, 1, 0.05, 5),
          cloud("1e5 from the origin", {1e5, -1e5, 1e5}, 1, 0.1, 3),
          cloud("1e7 from the origin", {1e7, 0, -1e7}, 40, 5, 100),
          cloud("tiny and far, F / r = 4e6", {0, 0, 0}, 1e-5, 1e-6, 4),
          cloud("a speck, F / r = 1e8", {0, 0, 0}, 3e-7, 8e-8, 4),
          cloud("in units of 1e-12", {0, 0, 0}, 1e-12, 1e-13, 3e-12),
          cloud("in units of 1e12", {0, 0, 0}, 1e12, 1e11, 3e12),
          lattice(),
          skimming(),
          on_the_ground(),
          copies(),
          between_floats(),
          row_of_specks(),
          nearly_along_axes(),
          sources_ahead(),
          sources_among_copies(),
          beyond_the_filter()};
}

class Tree : public OnEachIsa {};

TEST_P(Tree, GivesTheScalarPathsAnswers) {
  for (const TreeScene& scene : scenes()) {
    const Geometry geometry(scene.spheres, {});
    ASSERT_GT(geometry.view().bvh.size, 0U) << "no tree";
    std::vector<Hit> expected;
    for (const Ray& ray : scene.rays)
      expected.push_back(reference::closest_hit(ray, scene.spheres, {}));
    std::size_t met = 0;
    for (const Form form : {Form::packet, Form::single, Form::flight, Form::set}) {
      const Query query{Solver::robust, form, Coherence::none};
      const auto hits = run_closest(*kernels, geometry.view(), scene.rays, query);
      const auto occluded = run_any(*kernels, geometry.view(), scene.rays, query);
      for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = expected[i];
        ASSERT_TRUE(same_bits(hits[i], hit))
            << scene.name << " ray " << i << " form " << static_cast<int>(form) << ": "
            << hits[i].id << " " << hits[i].t << ", expected " << hit.id << " " << hit.t;
        ASSERT_EQ(occluded[i], hit.id < 0 ? 0 : 1) << scene.name << " ray " << i;
        met += hit.id < 0 ? 0U : 1U;
      }
    }
    EXPECT_GT(met, scene.rays.size() / 4) << scene.name;
    const auto sorted = run_sorted(*kernels, geometry.view(), scene.rays);
    for (std::size_t i = 0; i < sorted.size(); ++i)
      ASSERT_TRUE(same_bits(sorted[i], expected[i])) << scene.name << " ray " << i << ", sorted";
  }
}

/// Rays that all hit something hit what the scalar path says.
void expect_hits_in_all_forms(const KernelTable& kernels, const Geometry& geometry,
                              const std::vector<Ray>& rays, const std::vector<Sphere>& spheres) {
  for (const Form form : {Form::packet, Form::single, Form::flight, Form::set}) {
    const auto hits =
        run_closest(kernels, geometry.view(), rays, {Solver::robust, form, Coherence::none});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit expected = reference::closest_hit(rays[i], spheres, {});
      ASSERT_GE(expected.id, 0);
      ASSERT_TRUE(same_bits(hits[i], expected)) << "ray " << i;
    }
  }
}

/// Rays enter nearly every box of a deep tree: more children wait than a ray in flight keeps in
/// order.
TEST_P(Tree, ManyOverlappingChildrenMayBePending) {
  CaseRandom random(59);
  std::vector<Sphere> spheres;
  for (int i = 0; i < 80'000; ++i) {
    const auto radius = static_cast<float>(random.uniform(0.2, 0.4));
    spheres.push_back({float_point(random, {0, 0, 0}, 1), radius, 0});
  }
  std::vector<Ray> rays;
  for (int i = 0; i < 48; ++i) {
    const Vec3d from = random.direction() * (i % 3 == 0 ? 0.5 : 2.5);
    const Vec3d to = vec_cast<double>(float_point(random, {0, 0, 0}, 1));
    rays.push_back({from, vec_cast<float>(to - from)});
  }
  const Geometry geometry(spheres, {});
  expect_hits_in_all_forms(*kernels, geometry, rays, spheres);
}

/// Rays from 2^100 away: components of their directions that are too small for floats take them far
/// away from the axis.
TEST_P(Tree, RaysBeyondFilterRangeEnterEveryBox) {
  std::vector<Sphere> spheres;
  std::vector<Ray> rays;
  for (int i = 0; i < 100; ++i) {
    const double y = std::ldexp(8 * i + 1, -40);
    const Vec3d center{std::ldexp(i - 50, -30), y, 0};
    spheres.push_back({vec_cast<float>(center), 0x1p-41F, 0});
    rays.push_back({{-0x1p100, 0, 0}, vec_cast<float>(Vec3d{0x1p20, y * 0x1p-80, 0})});
    rays.back().tmax = 0x1p81F;
  }
  const Geometry geometry(spheres, {}, Structure::bvh);
  expect_hits_in_all_forms(*kernels, geometry, rays, spheres);
}

/// The CPU time, in clock ticks, of rays along z, tilted a little, through a large tree; the least
/// of three.
std::clock_t time_of(const KernelTable& kernels, const Geometry& geometry, Form form, float tilt) {
  std::vector<Ray> rays;
  for (int i = 0; i < 64; ++i) {
    const double at = 0.05 + i * 1e-3;
    rays.push_back({{at, at, -1}, {tilt, 2 * tilt, 1}});
  }
  std::clock_t least = std::numeric_limits<std::clock_t>::max();
  for (int run = 0; run < 3; ++run) {
    const std::clock_t begin = std::clock();
    run_closest(kernels, geometry.view(), rays, {Solver::robust, form, Coherence::none});
    least = std::min(least, std::clock() - begin);
  }
  return least;
}

/// A ray that runs along an axis meets the planes of boxes beside it at infinite t. Not all of
/// these boxes may be visited, which would take hundreds of times as long.
TEST_P(Tree, RaysAlongAnAxisAreNoSlower) {
  CaseRandom random(57);
  std::vector<Sphere> spheres;
  for (int i = 0; i < 200'000; ++i)
    spheres.push_back({float_point(random, {0, 0, 0}, 1), 1e-3F, 0});
  const Geometry geometry(spheres, {});
  for (const Form form : {Form::packet, Form::single, Form::flight, Form::set})
    EXPECT_LT(time_of(*kernels, geometry, form, 0), 20 * time_of(*kernels, geometry, form, 1e-3F))
        << "form " << static_cast<int>(form);
}

INSTANTIATE_TEST_SUITE_P(Tables, Tree, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test::tree
