// Bundles that have many leaves in sight for their rays. They look past groups of rays that are
// done, and their rays go as sets where each leaf is for few of them: the hits are those of
// packets, and those of the scalar path.
#include <cmath>
#include <optional>
#include <vector>

#include "tests/equivalence/bundle_tiles.h"
#include "tests/support/placed_groups.h"

namespace boule::test {
namespace {

class SparseBundle : public OnEachIsa {
 protected:
  /// The nearest hits of a tile of 1024 rays, from its eye and along one direction.
  void check_tile(const BundleScene& scene, const Tile& tile) {
    check_tile(scene, Geometry(scene.spheres, scene.planes), tile);
  }
  /// The same in another geometry of the scene.
  void check_tile(const BundleScene& scene, const Geometry& geometry, const Tile& tile) {
    for (const Coherence coherence : {Coherence::common_origin, Coherence::common_direction}) {
      const bool one_origin = coherence == Coherence::common_origin;
      const auto rays =
          one_origin ? from_one_origin(tile, scene.eye) : in_one_direction(tile, scene.eye);
      SCOPED_TRACE(one_origin ? "one origin" : "one direction");
      const auto hits = run_closest(*kernels, geometry.view(), rays,
                                    {Solver::robust, Form::automatic, coherence});
      const auto packets = run_closest(*kernels, geometry.view(), rays, as_packets);
      met = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(same_bits(hits[i], packets[i])) << scene.name << " ray " << i;
        met += hits[i].id < 0 ? 0U : 1U;
        if (i % sample != 0) continue;
        const Hit expected = reference::closest_hit(rays[i], scene.spheres, scene.planes);
        ASSERT_TRUE(same_bits(hits[i], expected)) << scene.name << " ray " << i;
      }
      EXPECT_GT(met, rays.size() / 50);
      EXPECT_LT(met, rays.size());
    }
  }
  /// Whether rays meet anything.
  void check_any(const BundleScene& scene, const std::vector<Ray>& rays, Coherence coherence) {
    const Geometry geometry(scene.spheres, scene.planes);
    const auto occluded =
        run_any(*kernels, geometry.view(), rays, {Solver::robust, Form::automatic, coherence});
    const auto packets = run_any(*kernels, geometry.view(), rays, as_packets);
    met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(occluded[i], packets[i]) << scene.name << " ray " << i;
      met += occluded[i] != 0 ? 1U : 0U;
      if (i % sample != 0) continue;
      const bool expected = reference::any_hit(rays[i], scene.spheres, scene.planes);
      ASSERT_EQ(occluded[i], expected ? 1 : 0) << scene.name << " ray " << i;
    }
    EXPECT_GT(met, rays.size() / 10);
    EXPECT_LT(met, rays.size() * 9 / 10);
  }
  static constexpr Query as_packets = {Solver::robust, Form::packet, Coherence::none};
  static constexpr std::size_t sample = 13;
  std::size_t met = 0;  ///< rays that met something
};

/// Spheres in a flat disc around the origin, as high as 0.01 along z.
BundleScene flat_disc(CaseRandom& random, int count, double radius) {
  BundleScene scene{"disc", {}, {0, -4, 0.08}};
  for (int i = 0; i < count; ++i) {
    const Vec3d at = random.direction() * std::sqrt(random.uniform(0, 1));
    const Vec3f center = vec_cast<float>(Vec3d{at.x, at.y, random.uniform(-0.005, 0.005)});
    scene.spheres.push_back({center, static_cast<float>(radius * random.uniform(0.5, 1)), 0});
  }
  return scene;
}

/// A disc seen edge-on: each of its leaves is for about a ray, and most rays miss all.
TEST_P(SparseBundle, GoesAsSetsPastADisc) {
  CaseRandom random(81);
  BundleScene scene = flat_disc(random, 8000, 0.01);
  const Tile tile{{0, 0, 0}, {1.05, 0, 0}, {0, 0, 0.5}, 1, 32};
  check_tile(scene, tile);
  scene.planes = {{{0, 0, -0.3F}, {0, 0.1F, 1}, 0}};
  check_tile(scene, tile);
}

/// A disc of two parts, where there are no sets.
TEST_P(SparseBundle, GoesAsPacketsPastParts) {
  CaseRandom random(81);
  const BundleScene part = flat_disc(random, 4000, 0.01);
  const PlacedGroups groups{
      "parts", {part.spheres}, {{0, std::nullopt}, {0, placed({0, 0, 57}, 1, {0.1, 0, 0})}}};
  const BundleScene scene{groups.name, groups.written_out(), part.eye};
  check_tile(scene, groups.in_parts({}, Structure::bvh),
             {{0, 0, 0}, {1.05, 0, 0}, {0, 0, 0.5}, 1, 32});
}

/// A cloud of specks, half of it hidden by spheres amid it.
TEST_P(SparseBundle, SkipsGroupsThatAreDone) {
  for (const double shift : {0.0, 3.0, 1e4}) {
    CaseRandom random(82);
    const Vec3d middle{shift, -shift, shift};
    BundleScene scene{"specks", {}, middle + Vec3d{0, 0, 4}};
    const auto add = [&](const Vec3d& at, double radius) {
      scene.spheres.push_back({vec_cast<float>(middle + at), static_cast<float>(radius), 0});
    };
    for (int i = 0; i < 6000; ++i) {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-2, 2);
      add({x, y, z}, 0.01 * random.uniform(0.3, 1));
    }
    for (int i = 0; i < 40; ++i) add({random.uniform(-1, -0.1), random.uniform(-1, 1), 1.8}, 0.2);
    check_tile(scene, {middle, {0.9, 0, 0}, {0, 0.9, 0}, 1, 32});
  }
}

/// `count` shadow rays from anywhere on the spheres to a light.
std::vector<Ray> to_a_light(CaseRandom& random, const BundleScene& scene, int count,
                            bool is_point) {
  const Vec3d light{-1, -1.5, is_point ? 3.0 : 2.0};
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const int source = random.below(static_cast<int>(scene.spheres.size()));
    const Sphere& sphere = scene.spheres[static_cast<std::size_t>(source)];
    const Vec3d normal = random.direction();
    Ray ray{center_of(sphere) + normal * (double{sphere.radius} * (1 + 0x1p-40)),
            vec_cast<float>(light)};
    ray.source = source;
    if (is_point) {
      ray.dir = vec_cast<float>(light - ray.org);
      ray.tmax = 1 - 0x1p-22F;
    }
    rays.push_back(ray);
  }
  return rays;
}

/// Shadow rays from a disc with more leaves than rays: their sorted bundles are sparse, so they go
/// unsorted, the few as well as the many that have a trial.
TEST_P(SparseBundle, GoesUnsortedToALight) {
  for (const int count : {300, 4500}) {
    CaseRandom random(83);
    const BundleScene scene = flat_disc(random, 40 * count, count < 1000 ? 0.008 : 0.003);
    for (const bool is_point : {true, false}) {
      const std::vector<Ray> rays = to_a_light(random, scene, count, is_point);
      SCOPED_TRACE(testing::Message() << count << (is_point ? " to a point" : ""));
      check_any(scene, rays, is_point ? Coherence::common_end : Coherence::common_direction);
      if (HasFatalFailure()) return;
    }
  }
}

/// The same rays: a trial learns that sorting does not pay, of three bundles as well as of many.
/// One bundle alone has no trial.
TEST_P(SparseBundle, LearnsFromTwoBundlesOrMore) {
  CaseRandom random(84);
  const BundleScene scene = flat_disc(random, 200000, 0.003);
  const Geometry geometry(scene.spheres, {});
  for (const int count : {1500, 2500, 5000}) {
    const std::vector<Ray> rays = to_a_light(random, scene, count, true);
    Experience::Sorting found;
    // The clock may err, because the system runs other programs, too.
    for (int attempt = 0; attempt < 5 && found.pays != 0; ++attempt) {
      Experience known;
      run_any(*kernels, geometry.view(), rays,
              {Solver::robust, Form::automatic, Coherence::common_end, &known});
      found = known.sorting;
    }
    EXPECT_EQ(found.pays, count < 2048 ? 2U : 0U) << count;
    EXPECT_EQ(found.left > 0, count > 2048) << count;
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, SparseBundle, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
