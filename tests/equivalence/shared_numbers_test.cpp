// Rays whose stream has what they share once: every kernel reads it there, in every form, and the
// answers are those of rays that have all numbers for themselves.
#include "tests/equivalence/bundle_tiles.h"
#include "tests/support/expect_same.h"
#include "tests/support/placed_groups.h"

namespace boule::test {
namespace {

class SharedNumbersOf : public OnEachIsa {
 protected:
  /// Rays from one point, or in one direction, towards the unit sphere.
  static std::vector<Ray> rays_with(CommonPart common, std::size_t count) {
    CaseRandom random(91);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d offset{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0};
      rays.push_back(common == CommonPart::origin
                         ? Ray{{0.1, -0.2, 5}, vec_cast<float>(offset - Vec3d{0.1, -0.2, 5})}
                         : Ray{Vec3d{0.1, -0.2, 5} + offset * 2.0, {0.25F, 0.125F, -4}});
      if (i % 5 == 3) rays.back().tmax = static_cast<float>(random.uniform(0.5, 1.2));
    }
    return rays;
  }

  /// The answers to both of these streams are the same.
  void check(const GeometryView& geometry, RayStream alone, RayStream shared, const Query& query) {
    const std::size_t size = alone.size;
    HitBuffer expected(size), found(size);
    kernels->closest_hit(geometry, alone, query, expected.view());
    kernels->closest_hit(geometry, shared, query, found.view());
    AlignedArray<std::uint8_t> met(size, 7), found_met(size, 8);
    kernels->any_hit(geometry, alone, query, met.data());
    kernels->any_hit(geometry, shared, query, found_met.data());
    for (std::size_t i = 0; i < size; ++i) {
      ASSERT_TRUE(same_bits(expected.get(i), found.get(i))) << i << " of " << size;
      ASSERT_EQ(met[i], found_met[i]) << i << " of " << size;
      hits += met[i];
    }
  }
  void check_all_forms(const GeometryView& geometry, const std::vector<Ray>& rays,
                       CommonPart common) {
    RayBuffer alone = to_stream(rays), shared = to_shared_stream(rays, common);
    for (const Query& query : {Query{Solver::robust, Form::automatic, coherence_of(common)},
                               Query{Solver::robust, Form::automatic, Coherence::none},
                               Query{Solver::robust, Form::packet, Coherence::none},
                               Query{Solver::robust, Form::single, Coherence::none},
                               Query{Solver::robust, Form::flight, Coherence::none},
                               Query{Solver::robust, Form::set, Coherence::none},
                               Query{Solver::fast, Form::packet, Coherence::none}}) {
      SCOPED_TRACE(testing::Message() << "form " << static_cast<int>(query.form));
      check(geometry, alone.view(), shared.view(), query);
      const std::size_t first = rays.size() / 2 / max_width * max_width, left = rays.size() - first;
      check(geometry, part(alone.view(), first, left), part(shared.view(), first, left), query);
    }
  }

  std::size_t hits = 0;
};

constexpr CommonPart parts_in_common[] = {CommonPart::origin, CommonPart::direction};

TEST_P(SharedNumbersOf, StreamsAgreeInEveryForm) {
  const BundleScene scene = cloud("outside", {0, 0, 0}, 1, 0.1, 5);
  const Geometry tree(scene.spheres, {{{0, -0.5F, 0}, {0, 1, 0}, 0}});
  const Geometry few({scene.spheres.begin(), scene.spheres.begin() + 9}, {});
  for (const CommonPart common : parts_in_common) {
    for (const std::size_t count : {1U, 7U, 15U, 16U, 17U, 33U, 130U, 1029U, 2600U}) {
      check_all_forms(tree.view(), rays_with(common, count), common);
      check_all_forms(few.view(), rays_with(common, count), common);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(hits, 1000U);
}

TEST_P(SharedNumbersOf, RaysMayBeginAnywhereAndLeaveAnything) {
  const BundleScene scene = cloud("outside", {0, 0, 0}, 1, 0.1, 5);
  const Geometry geometry(scene.spheres, {});
  for (const CommonPart common : parts_in_common) {
    for (const float tmin : {-3.0F, 0.9F, 1.02F, std::nanf("")}) {
      for (const std::int32_t source : {no_primitive, 3}) {
        std::vector<Ray> rays = rays_with(common, 300);
        for (Ray& ray : rays) {
          ray.tmin = tmin;
          ray.source = source;
        }
        check_all_forms(geometry.view(), rays, common);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(hits, 1000U);
}

/// From a point of a sphere's inside they meet it again, or others that it overlaps.
TEST_P(SharedNumbersOf, RaysLeaveASphereOnItsInside) {
  std::vector<Sphere> spheres = cloud("outside", {0, 0, 0}, 1, 0.1, 5).spheres;
  spheres[3] = {{0, 0, 0}, 1, 0};
  const Geometry geometry(spheres, {});
  CaseRandom random(92);
  std::vector<Ray> rays(3000, Ray{{0, 0, 1}, {}});
  for (Ray& ray : rays) {
    ray.dir = vec_cast<float>(random.direction());
    ray.source = 3;
    ray.inside = true;
  }
  check_all_forms(geometry.view(), rays, CommonPart::origin);
  EXPECT_GT(hits, rays.size());
}

/// Among so many leaves shadow rays of one direction are sorted.
TEST_P(SharedNumbersOf, RaysInOneDirectionAreSorted) {
  std::vector<Sphere> spheres;
  CaseRandom random(93);
  for (int i = 0; i < 6000; ++i)
    spheres.push_back({vec_cast<float>(random.direction() * random.uniform(0, 1)), 0.005F, 0});
  const Geometry geometry(spheres, {});
  std::vector<Ray> rays;
  for (int i = 0; i < 3000; ++i) {
    const double x = random.uniform(-1, 1);
    rays.push_back({{x, random.uniform(-1, 1), 5}, {0.25F, 0.125F, -4}});
  }
  check_all_forms(geometry.view(), rays, CommonPart::direction);
  EXPECT_GT(hits, 100U);
}

TEST_P(SharedNumbersOf, RaysMeetPartsThatWerePlaced) {
  const BundleScene scene = cloud("outside", {0, 0, 0}, 1, 0.1, 5);
  const PlacedGroups groups{
      "twice", {scene.spheres}, {{0, {}}, {0, placed({20, 0, 70}, 0.75, {0.3, 0.1, 1})}}};
  const Geometry geometry = groups.in_parts({}, Structure::bvh);
  for (const CommonPart common : parts_in_common)
    check_all_forms(geometry.view(), rays_with(common, 700), common);
  EXPECT_GT(hits, 1000U);
}

/// Points and directions of the surfaces that rays meet.
struct FoundSurfaces {
  static constexpr std::size_t count = 203;

  VectorBuffer point, normal, view, mirrored, org;
  AlignedArray<double> cosine{count}, reach{count};
  AlignedArray<std::uint8_t> inner{count}, inside{count};

  FoundSurfaces(const KernelTable& kernels, const GeometryView& geometry, RayBuffer& rays,
                HitBuffer& hits) {
    for (VectorBuffer* vectors : {&point, &normal, &view, &mirrored, &org}) vectors->resize(count);
    kernels.closest_hit(geometry, rays.view(), {}, hits.view());
    kernels.find_surfaces(geometry, rays.view(), hits.view(),
                          {point.view(), normal.view(), view.view(), mirrored.view(), org.view(),
                           cosine.data(), reach.data(), inner.data(), inside.data()});
  }
};

TEST_P(SharedNumbersOf, SurfacesAreTheSame) {
  const BundleScene scene = cloud("outside", {0, 0, 0}, 1, 0.1, 5);
  const Geometry geometry(scene.spheres, {{{0, -0.5F, 0}, {0, 1, 0}, 0}});
  for (const CommonPart common : parts_in_common) {
    const std::vector<Ray> rays = rays_with(common, FoundSurfaces::count);
    HitBuffer met(rays.size());
    RayBuffer alone = to_stream(rays), shared = to_shared_stream(rays, common);
    FoundSurfaces expected(*kernels, geometry.view(), alone, met);
    FoundSurfaces found(*kernels, geometry.view(), shared, met);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (met.get(i).id == no_primitive) continue;
      ++hits;
      expect_same(found.point.get(i), expected.point.get(i));
      expect_same(found.normal.get(i), expected.normal.get(i));
      expect_same(found.view.get(i), expected.view.get(i));
      expect_same(found.org.get(i), expected.org.get(i));
      expect_same(found.mirrored.get(i), expected.mirrored.get(i));
      expect_same(found.cosine[i], expected.cosine[i]);
      expect_same(found.reach[i], expected.reach[i]);
      EXPECT_EQ(found.inner[i], expected.inner[i]);
      EXPECT_EQ(found.inside[i], expected.inside[i]);
    }
  }
  EXPECT_GT(hits, 20U);
}

INSTANTIATE_TEST_SUITE_P(Tables, SharedNumbersOf, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
