// Sets of rays that go down the tree together. The answers are the scalar path's, whatever the
// length of the stream and the rays beside a ray.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/kernel_runs.h"
#include "tests/support/placed_groups.h"

namespace boule::test {
namespace {

class Sets : public OnEachIsa {
 protected:
  /// The first `count` rays have the hits `expected`, as sets and as what sets replace.
  void check(const Geometry& geometry, const std::vector<Ray>& rays,
             const std::vector<Hit>& expected, std::size_t count) const {
    const std::vector<Ray> first(rays.begin(), rays.begin() + static_cast<std::ptrdiff_t>(count));
    for (const Form form : {Form::set, Form::flight, Form::automatic}) {
      SCOPED_TRACE(testing::Message() << count << " rays, form " << static_cast<int>(form));
      const Query query{Solver::robust, form, Coherence::none};
      const auto hits = run_closest(*kernels, geometry.view(), first, query);
      const auto occluded = run_any(*kernels, geometry.view(), first, query);
      ASSERT_EQ(hits.size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_TRUE(same_bits(hits[i], expected[i]))
            << "ray " << i << ": " << hits[i].id << " " << hits[i].t << ", expected "
            << expected[i].id << " " << expected[i].t;
        ASSERT_EQ(occluded[i], expected[i].id != no_primitive ? 1 : 0) << "ray " << i;
      }
    }
  }
};

std::vector<Hit> scalar_hits(const std::vector<Ray>& rays, const std::vector<Sphere>& spheres,
                             const std::vector<Plane>& planes) {
  std::vector<Hit> hits;
  hits.reserve(rays.size());
  for (const Ray& ray : rays) hits.push_back(reference::closest_hit(ray, spheres, planes));
  return hits;
}

/// Rays through a cloud, among them such as go alone (with hits behind their origins, from beyond
/// what float can judge, without a direction) and such as meet nothing.
std::vector<Ray> mixed_rays(std::size_t count) {
  CaseRandom random(71);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d from = random.direction() * random.uniform(0, 3);
    const Vec3d to = random.direction() * random.uniform(0, 1);
    Ray ray{from, vec_cast<float>(to - from)};
    if (i % 9 == 4) ray.tmin = -2;
    if (i % 13 == 5) ray.tmax = 0;
    if (i % 17 == 6) ray.dir = {0, 0, 0};
    if (i % 19 == 7) ray.dir.y = std::nanf("");
    if (i % 23 == 8) ray.org.x = 1e20;
    if (i % 5 == 3) ray.tmax = static_cast<float>(random.uniform(0, 1));
    rays.push_back(ray);
  }
  return rays;
}

TEST_P(Sets, OfAnyLengthEqualTheScalarPath) {
  CaseRandom random(72);
  std::vector<Sphere> spheres = cube_of_spheres(random, 600, {}, 1, 0.08);
  spheres.push_back({{0.2F, 0.1F, 0}, 0.9F, 0});  // in no leaf
  const std::vector<Plane> planes = {{{0, -0.9F, 0}, {0.1F, 1, 0}, 0}};
  const Geometry geometry(spheres, planes);
  ASSERT_GT(geometry.view().bvh.size, 0U);
  const std::vector<Ray> rays = mixed_rays(1100);
  const std::vector<Hit> expected = scalar_hits(rays, spheres, planes);
  std::size_t met = 0;
  for (const Hit& hit : expected) met += hit.id != no_primitive ? 1U : 0U;
  EXPECT_GT(met, rays.size() / 4);
  EXPECT_LT(met, rays.size() * 9 / 10);
  for (const std::size_t count : {1U, 5U, 16U, 31U, 255U, 256U, 257U, 511U, 513U, 1100U})
    check(geometry, rays, expected, count);
}

/// `count` rays that begin near (0, 0, 1.2), or anywhere, and go to a ball of radius 0.8.
std::vector<Ray> rays_from(CaseRandom& random, std::size_t count, bool anywhere) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d from = Vec3d{0, 0, 1.2} + random.direction() * (anywhere ? 3 : 0.01);
    rays.push_back({from, vec_cast<float>(random.direction() * 0.8 - from)});
  }
  return rays;
}

/// So many that trials are made again and again: the first ones begin in one place, those in the
/// middle anywhere, the last ones again in one place.
TEST_P(Sets, CanSwitchFormWithinAStream) {
  CaseRandom random(74);
  const std::vector<Sphere> spheres = cube_of_spheres(random, 900, {}, 1, 0.05);
  const Geometry geometry(spheres, {});
  std::vector<Ray> rays;
  for (const bool anywhere : {false, true, false}) {
    const std::vector<Ray> more = rays_from(random, 8000, anywhere);
    rays.insert(rays.end(), more.begin(), more.end());
  }
  const auto expected =
      run_closest(*kernels, geometry.view(), rays, {Solver::robust, Form::packet, Coherence::none});
  for (std::size_t i = 0; i < rays.size(); i += 1000)
    ASSERT_TRUE(same_bits(expected[i], reference::closest_hit(rays[i], spheres, {}))) << i;
  check(geometry, rays, expected, rays.size());
}

/// Streams of all lengths, most of them too short for a whole trial, of which each knows what those
/// before it found out.
TEST_P(Sets, UseTheExperienceOfEarlierStreams) {
  CaseRandom random(75);
  const std::vector<Sphere> spheres = cube_of_spheres(random, 900, {}, 1, 0.05);
  const Geometry geometry(spheres, {});
  ASSERT_GT(geometry.view().bvh.size, 0U);
  Experience nearest, any;
  const std::size_t lengths[] = {0, 1, 7, 16, 100, 255, 256, 257, 290, 333, 1000, 3000};
  for (const bool anywhere : {false, true, false}) {
    for (int round = 0; round < 2; ++round) {
      for (const std::size_t length : lengths) {
        const std::vector<Ray> rays = rays_from(random, length, anywhere);
        const auto expected = run_closest(*kernels, geometry.view(), rays,
                                          {Solver::robust, Form::packet, Coherence::none});
        const auto hits = run_closest(*kernels, geometry.view(), rays,
                                      {Solver::robust, Form::automatic, Coherence::none, &nearest});
        const auto occluded = run_any(*kernels, geometry.view(), rays,
                                      {Solver::robust, Form::automatic, Coherence::none, &any});
        for (std::size_t i = 0; i < length; ++i) {
          ASSERT_TRUE(same_bits(hits[i], expected[i])) << i << " of " << length;
          ASSERT_EQ(occluded[i], expected[i].id != no_primitive ? 1 : 0) << i << " of " << length;
        }
      }
    }
  }
}

/// Streams of which none has room for a trial and for what follows it.
TEST_P(Sets, MakeFewTrialsInManyShortStreams) {
  CaseRandom random(76);
  const Geometry geometry(cube_of_spheres(random, 900, {}, 1, 0.05), {});
  const std::vector<Ray> rays = rays_from(random, 100, false);
  const auto trace = [&](Experience* known, bool any) {
    const Query query{Solver::robust, Form::automatic, Coherence::none, known};
    if (any) {
      run_any(*kernels, geometry.view(), rays, query);
    } else {
      run_closest(*kernels, geometry.view(), rays, query);
    }
  };
  for (const bool any : {false, true}) {
    Experience known;
    trace(&known, any);
    EXPECT_EQ(known.left, 0U);  // a trial is under way
    EXPECT_GT(known.next_way, 0U);
    for (int stream = 0; stream < 15; ++stream) trace(&known, any);
    EXPECT_GE(known.rays, 1984U);
    EXPECT_EQ(known.next_way, 0U);
    const std::uint32_t left = known.left;
    trace(&known, any);
    EXPECT_EQ(known.left, left - 100) << "any " << any;
  }
}

/// What was found out belongs to one table and one function of it. Where a caller mixes them, in
/// the midst of trials too, hits are the same.
TEST(SetsOfAllTables, ForeignExperienceChangesNoHit) {
  CaseRandom random(77);
  const Geometry geometry(cube_of_spheres(random, 900, {}, 1, 0.05), {});
  ASSERT_GT(geometry.view().bvh.size, 0U);
  Experience known;
  const Query query{Solver::robust, Form::automatic, Coherence::none, &known};
  for (std::size_t round = 0; round < 40; ++round) {
    const std::vector<Ray> rays = rays_from(random, 1 + round * 67 % 400, round % 3 == 1);
    const auto expected = run_closest(reference_kernels(), geometry.view(), rays, {});
    for (const std::string& name : all_isa_names()) {
      const KernelTable* kernels = kernels_or_null(name);
      if (kernels == nullptr) continue;
      const auto hits = run_closest(*kernels, geometry.view(), rays, query);
      const auto occluded = run_any(*kernels, geometry.view(), rays, query);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(same_bits(hits[i], expected[i])) << name << ", ray " << i;
        ASSERT_EQ(occluded[i], expected[i].id != no_primitive ? 1 : 0) << name << ", ray " << i;
      }
    }
  }
  EXPECT_GT(known.rays, 0U);
}

/// From so far that float can tell of no speck whether a ray meets it: every ray has hundreds of
/// candidates, more than a set has room for.
TEST_P(Sets, OverflowingCandidatesAreSolvedEarly) {
  CaseRandom random(73);
  std::vector<Sphere> specks;
  for (int i = 0; i < 500; ++i) {
    const Vec3d center{1e6 + i * 0.25, random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01)};
    specks.push_back({vec_cast<float>(center), 1e-3F, 0});
  }
  const Geometry geometry(specks, {});
  ASSERT_GT(geometry.view().bvh.size, 0U);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < 300; ++i) {
    Vec3f to = specks[i].center;
    if (i % 4 == 0) to.y += 0.015F;
    rays.push_back({{0, 0, 0}, to});
  }
  const std::vector<Hit> expected = scalar_hits(rays, specks, {});
  std::size_t met = 0;
  for (const Hit& hit : expected) met += hit.id != no_primitive ? 1U : 0U;
  EXPECT_GT(met, 200U);
  EXPECT_LT(met, 300U);
  check(geometry, rays, expected, rays.size());
}

INSTANTIATE_TEST_SUITE_P(Tables, Sets, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
