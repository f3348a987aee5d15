// Tiles of rays that share an origin or a direction: the bundle's answers are the scalar path's.
#include <cmath>
#include <vector>

#include "tests/equivalence/bundle_tiles.h"

namespace boule::test {
namespace {

TEST_P(Bundle, GivesTheScalarPathsAnswers) {
  for (const BundleScene& scene : bundle_scenes()) {
    for (const Structure structure : {Structure::scan, Structure::bvh}) {
      const Geometry geometry(scene.spheres, {}, structure);
      CaseRandom random(62);
      met = 0;
      constexpr int tiles = 24;
      for (int k = 0; k < tiles; ++k) {
        Tile tile = random_tile(random, scene);
        tile.side = 8 << k % 3;
        if (!judgeable(tile)) continue;
        std::vector<Ray> rays = from_one_origin(tile, scene.eye);
        const double until = length(tile.middle - scene.eye) / tile.length;
        shorten(random, until, rays);
        check(scene, {}, geometry, rays, Coherence::common_origin);
        rays = in_one_direction(tile, scene.eye);
        shorten(random, until, rays);
        check(scene, {}, geometry, rays, Coherence::common_direction);
        if (HasFatalFailure()) return;
      }
      EXPECT_GT(met, std::size_t{tiles * 64}) << scene.name;
    }
  }
}

TEST_P(Bundle, MeetsPlanesAsWell) {
  const BundleScene scene = cloud("over a floor", {0, 0, 0}, 1, 0.1, 5);
  const std::vector<Plane> planes = {{{0, -0.5F, 0}, {0, 1, 0}, 0}, {{0, 0, -3}, {0, 0.1F, 1}, 0}};
  const Geometry geometry(scene.spheres, planes), floor_only({}, planes);
  CaseRandom random(63);
  for (int k = 0; k < 20; ++k) {
    const Tile tile = random_tile(random, scene);
    check(scene, planes, geometry, from_one_origin(tile, scene.eye), Coherence::common_origin);
    check({}, planes, floor_only, in_one_direction(tile, scene.eye), Coherence::common_direction);
  }
}

/// Streams of any size, tiles too wide for a bundle, rays in no order, and promises not kept.
TEST_P(Bundle, TakesAnyStream) {
  const BundleScene scene = cloud("outside", {0, 0, 0}, 1, 0.1, 3);
  const Geometry geometry(scene.spheres, {});
  CaseRandom random(64);
  for (const int count : {1, 15, 31, 32, 33, 100, 255, 256, 257, 300, 513, 1000}) {
    std::vector<Ray> wide, none;
    for (int i = 0; i < count; ++i) {
      const double x = random.uniform(-1, 1);
      const double y = random.uniform(-1, 1);
      wide.push_back({scene.eye, vec_cast<float>(Vec3d{2 * x, 2 * y, -3 * y * y - 1})});
      none.push_back({scene.eye + Vec3d{x, y, 0}, vec_cast<float>(Vec3d{-x, x * y, -3})});
    }
    for (const Coherence coherence :
         {Coherence::common_origin, Coherence::common_direction, Coherence::common_end}) {
      check(scene, {}, geometry, wide, coherence);
      check(scene, {}, geometry, none, coherence);
    }
    wide[static_cast<std::size_t>(count / 2)].org.x += 1e-3;
    check(scene, {}, geometry, wide, Coherence::common_origin);
    wide = from_one_origin(random_tile(random, scene), scene.eye);
    wide[77].tmin = 2;
    wide[78].tmin = -9;
    wide[79].source = 5;
    wide[80].dir.z = std::nanf("");
    wide[200].tmax = std::nanf("");
    wide[201].tmax = -1;
    check(scene, {}, geometry, wide, Coherence::common_origin);
  }
}

/// Rays whose tmax is NaN hide nothing from the others, whichever ray of a group they are.
TEST_P(Bundle, LeavesOutRaysOfNaN) {
  for (const BundleScene& scene : {cloud("outside", {0, 0, 0}, 1, 0.1, 5), on_the_ground()}) {
    const Geometry geometry(scene.spheres, {});
    CaseRandom random(69);
    for (int k = 0; k < 40; ++k) {
      const Tile tile = random_tile(random, scene);
      std::vector<Ray> from_eye = from_one_origin(tile, scene.eye);
      std::vector<Ray> parallel = in_one_direction(tile, scene.eye);
      for (std::vector<Ray>* rays : {&from_eye, &parallel}) {
        for (std::size_t i = 0; i < rays->size(); ++i) {
          if (k == 0 ? i % 8 == 7 : random.chance(0.1)) (*rays)[i].tmax = std::nanf("");
        }
      }
      check(scene, {}, geometry, from_eye, Coherence::common_origin);
      check(scene, {}, geometry, parallel, Coherence::common_direction);
      if (HasFatalFailure()) return;
    }
  }
}

/// Spheres at, around and right in front of the eye, of sizes next to nothing, beside others; and
/// one so large that its square is no float.
TEST_P(Bundle, MeetsSpheresAtTheEye) {
  std::vector<Ray> from_eye, parallel;
  for (int i = 0; i < 64; ++i) {
    const float x = 1e-3F * static_cast<float>(even_bits(i)),
                y = 1e-3F * static_cast<float>(even_bits(i >> 1));
    from_eye.push_back({{0, 0, 0}, {x, y, 1}});
    parallel.push_back({{double{x}, double{y}, -5}, {0, 0, 1}});
  }
  const std::vector<Sphere> others = {{{0, 0, 5}, 0.004F, 0},
                                      {{0.02F, 0, 7}, 0.02F, 0},
                                      {{0, 0.05F, 9}, 0.03F, 0},
                                      {{0.01F, 0.02F, 4}, 0.01F, 0}};
  const std::vector<Sphere> hard = {{{0, 0, 1e-39F}, 4e-40F, 0}, {{0, 0, 0}, 0, 0},
                                    {{0, 0, 1e-30F}, 1e-31F, 0}, {{0, 0, 1e-18F}, 1e-20F, 0},
                                    {{0, 0, 1e-17F}, 4e-18F, 0}, {{0, 0, 0}, 2e19F, 0},
                                    {{0, 0, 0}, 1e15F, 0},       {{0, 0, 5}, 0, 0}};
  for (std::size_t which = 0; which <= hard.size(); ++which) {
    for (std::size_t at = 0; at <= others.size(); ++at) {
      BundleScene scene{"hard sphere " + std::to_string(which), others, {}};
      if (which < hard.size())
        scene.spheres.insert(scene.spheres.begin() + static_cast<std::ptrdiff_t>(at), hard[which]);
      while (scene.spheres.size() < 8) scene.spheres.push_back(others[1]);
      const Geometry geometry(scene.spheres, {});
      check(scene, {}, geometry, from_eye, Coherence::common_origin);
      check(scene, {}, geometry, parallel, Coherence::common_direction);
      if (HasFatalFailure()) return;
    }
  }
}

/// Rays all around the eye, over a hemisphere, and backwards: none may be lost where their bundle
/// is split.
TEST_P(Bundle, LooksEverywhere) {
  const BundleScene scene = cloud("all around", {0, 0, 0}, 3, 0.3, 0);
  const Geometry geometry(scene.spheres, {});
  CaseRandom random(65);
  for (int k = 0; k < 12; ++k) {
    const Vec3d w = random.direction(), u = random.perpendicular(w), v = cross(w, u);
    const double angle = random.uniform(0.01, 3);
    std::vector<Ray> rays;
    for (int i = 0; i < 256; ++i) {
      const double x = (even_bits(i) - 7.5) / 8, y = (even_bits(i >> 1) - 7.5) / 8;
      const double a = angle * x, b = angle * y;
      const Vec3d to =
          w * (std::cos(a) * std::cos(b)) + u * std::sin(a) + v * (std::sin(b) * std::cos(a));
      rays.push_back({scene.eye, vec_cast<float>(to)});
    }
    check(scene, {}, geometry, rays, Coherence::common_origin);
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, Bundle, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
