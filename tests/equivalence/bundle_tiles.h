#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/math/geometry.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {

/// Spheres and an eye that looks at them.
struct BundleScene {
  std::string name;
  std::vector<Sphere> spheres;
  Vec3d eye;
  double widest = 0.2;  ///< of the tiles, as a slope
  std::vector<Plane> planes = {};
};

inline Vec3d center_of(const Sphere& sphere) { return vec_cast<double>(sphere.center); }

/// 300 spheres in a cube of half the side `spread`, of at most that radius, seen from a distance.
inline BundleScene cloud(const std::string& name, const Vec3d& center, double spread, double radius,
                         double distance) {
  CaseRandom random(61);
  BundleScene scene{name, {}, {}};
  for (int i = 0; i < 300; ++i) {
    const double x = random.uniform(-spread, spread);
    const double y = random.uniform(-spread, spread);
    const double z = random.uniform(-spread, spread);
    const double r = radius * random.uniform(0.2, 1);
    scene.spheres.push_back({vec_cast<float>(center + Vec3d{x, y, z}), static_cast<float>(r), 0});
  }
  scene.eye = vec_cast<double>(vec_cast<float>(center + Vec3d{0, 0, distance}));
  return scene;
}

/// Every sphere three times, and two more next to it.
inline BundleScene copies() {
  BundleScene scene = cloud("copies and near copies", {0, 0, 0}, 1, 0.2, 4);
  for (std::size_t i = 60; i < 300; ++i) scene.spheres[i] = scene.spheres[i % 60];
  for (std::size_t i = 180; i < 300; ++i) {
    float& z = scene.spheres[i].center.z;
    z = std::nextafter(z, i < 240 ? 9.0F : -9.0F);
  }
  return scene;
}

inline BundleScene on_the_ground() {
  BundleScene scene = cloud("on a ground sphere, inside another", {0, 0.3, 0}, 0.5, 0.1, 3);
  scene.spheres.push_back({{0, -1e6F, 0}, 1e6F, 0});
  scene.spheres.push_back({{0, 0, 0}, 1e3F, 0});
  scene.spheres.push_back({{0, 0, 3.01F}, 0.5F, 0});
  return scene;
}

/// Some that no float filter can judge.
inline BundleScene with_degenerates() {
  BundleScene scene = cloud("degenerate spheres among others", {0, 0, 0}, 1, 0.2, 4);
  for (std::size_t i = 0; i < 8; ++i) scene.spheres[i].center.x = 1e19F;
  scene.spheres[8].radius = std::nanf("");
  scene.spheres[9].center.y = std::nanf("");
  scene.spheres[10] = {{0, 0, 2e19F}, 1.9e19F, 0};
  scene.spheres[11].radius = -scene.spheres[11].radius;
  scene.spheres[12].radius = 0;
  scene.spheres[13].radius = 1e-25F;
  scene.spheres[14] = {{0, 0, 1e16F}, 1e15F, 0};
  scene.spheres[15] = {{0, 0, -3e38F}, 3e37F, 0};
  return scene;
}

inline std::vector<BundleScene> bundle_scenes() {
  std::vector<BundleScene> all = {cloud("outside", {0, 0, 0}, 1, 0.1, 5),
                                  cloud("within", {0, 0, 0}, 1, 0.1, 0),
                                  cloud("1e5 from the origin", {1e5, -1e5, 1e5}, 1, 0.1, 3),
                                  cloud("far, F / r = 1e4", {0, 0, 0}, 1, 1e-3, 8),
                                  cloud("far and tiny, F / r = 4e6", {0, 0, 0}, 1e-5, 1e-6, 4),
                                  cloud("specks, F / r = 1e8", {0, 0, 0}, 3e-7, 8e-8, 4),
                                  cloud("in units of 1e-12", {0, 0, 0}, 1e-12, 1e-13, 3e-12),
                                  cloud("in units of 1e12", {0, 0, 0}, 1e12, 1e11, 3e12),
                                  copies(),
                                  on_the_ground(),
                                  with_degenerates()};
  all.push_back(cloud("from between two floats", {1e7, -1e7, 1e7}, 100, 5, 400));
  all.back().eye = all.back().eye + Vec3d{0.3, 0.21, 0.13};
  return all;
}

/// The even bits of a Morton index.
inline int even_bits(int i) {
  return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8) | (i >> 4 & 16);
}

/// A tile of rays, in Morton order, around the rim of a sphere, as wide as some share of what is
/// seen of the sphere: where a bound that is too small would show.
struct Tile {
  Vec3d middle, right, up;  ///< a target, and the tile's half sides from there
  double length;            ///< of the directions, as a multiple
  int side = 16;            ///< rays

  [[nodiscard]] int rays() const { return side * side; }
  /// The target of ray i.
  [[nodiscard]] Vec3d target(int i) const { return middle + offset(i); }
  [[nodiscard]] Vec3d offset(int i) const {
    const double half = side / 2.0;
    return right * ((even_bits(i) + 0.5 - half) / half) +
           up * ((even_bits(i >> 1) + 0.5 - half) / half);
  }
};

/// A tile around the rim of some sphere of the scene.
inline Tile random_tile(CaseRandom& random, const BundleScene& scene) {
  const Sphere& sphere =
      scene.spheres[static_cast<std::size_t>(random.below(static_cast<int>(scene.spheres.size())))];
  const Vec3d view = center_of(sphere) - scene.eye;
  const double distance = length(view), beta = 1 + random.sign() * random.decade(-9, -0.5);
  const Vec3d towards = normalize(view), side = random.perpendicular(towards);
  const double widest = scene.widest * distance;
  const double width = std::fmin(widest, std::fabs(double{sphere.radius}) * random.decade(-7, 1.5));
  // A sphere's box is touched where its rim is farthest along an axis.
  const Vec3d axis = std::array{Vec3d{1, 0, 0}, Vec3d{0, 1, 0},
                                Vec3d{0, 0, 1}}[static_cast<std::size_t>(random.below(3))];
  const Vec3d upright = axis - towards * dot(axis, towards);
  const Vec3d rim =
      random.chance(0.3) && length(upright) > 0 ? normalize(upright) * random.sign() : side;
  Tile tile{center_of(sphere) + rim * (beta * double{sphere.radius}), {}, {}, 1};
  tile.right = random.perpendicular(towards) * width;
  tile.up = cross(towards, tile.right);
  if (random.chance(0.3)) tile.length = random.decade(-3, 3);
  return tile;
}

/// Rays whose tmax ends some of them amid the spheres.
inline void shorten(CaseRandom& random, double until, std::vector<Ray>& rays) {
  if (!random.chance(0.25)) return;
  for (Ray& ray : rays) ray.tmax = static_cast<float>(until * random.uniform(0.9, 1.1));
}

inline std::vector<Ray> from_one_origin(const Tile& tile, const Vec3d& eye) {
  std::vector<Ray> rays;
  for (int i = 0; i < tile.rays(); ++i) {
    const Vec3d to = tile.target(i) - eye;
    rays.push_back({eye, vec_cast<float>(to * (tile.length / length(to)))});
  }
  return rays;
}

inline std::vector<Ray> in_one_direction(const Tile& tile, const Vec3d& eye) {
  const Vec3f dir = vec_cast<float>(normalize(tile.middle - eye) * tile.length);
  std::vector<Ray> rays;
  for (int i = 0; i < tile.rays(); ++i) rays.push_back({eye + tile.offset(i), dir});
  return rays;
}

/// Tiles of degenerate spheres are not.
inline bool judgeable(const Tile& tile) {
  return length(tile.middle) < 1e15 && length(tile.right) > 0;  // NaN is neither
}

/// The answers of one table's kernels to streams of rays with something in common, against those
/// of the scalar path.
class Bundle : public OnEachIsa {
 protected:
  /// The kernels' answers to one stream, with a promise, against the scalar path's.
  void check(const BundleScene& scene, const std::vector<Plane>& planes, const Geometry& geometry,
             const std::vector<Ray>& rays, Coherence coherence) {
    const Query query{Solver::robust, Form::automatic, coherence};
    const auto hits = run_closest(*kernels, geometry.view(), rays, query);
    const auto occluded = run_any(*kernels, geometry.view(), rays, query);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit expected = reference::closest_hit(rays[i], scene.spheres, planes);
      ASSERT_TRUE(same_bits(hits[i], expected))
          << scene.name << " ray " << i << ": " << hits[i].id << " " << hits[i].t << ", expected "
          << expected.id << " " << expected.t;
      ASSERT_EQ(occluded[i], expected.id < 0 ? 0 : 1) << scene.name << " ray " << i;
      met += expected.id < 0 ? 0U : 1U;
    }
  }
  /// Only whether the rays meet anything.
  void check_any(const BundleScene& scene, const Geometry& geometry, const std::vector<Ray>& rays,
                 Coherence coherence) {
    const Query query{Solver::robust, Form::automatic, coherence};
    const auto occluded = run_any(*kernels, geometry.view(), rays, query);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool expected = reference::any_hit(rays[i], scene.spheres, scene.planes);
      ASSERT_EQ(occluded[i], expected ? 1 : 0) << scene.name << " ray " << i;
      met += expected ? 1U : 0U;
    }
  }
  std::size_t met = 0;  ///< rays that met something
};

}  // namespace boule::test
