// Tiles of rays that share an origin or a direction: the bundle's answers are the scalar path's.
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/math/geometry.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

struct BundleScene {
  std::string name;
  std::vector<Sphere> spheres;
  Vec3d eye;
  double widest = 0.2;  ///< of the tiles, as a slope
  std::vector<Plane> planes = {};
};

Vec3d center_of(const Sphere& sphere) { return vec_cast<double>(sphere.center); }

BundleScene cloud(const std::string& name, const Vec3d& center, double spread, double radius,
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

/// Every sphere three times in the same place, and two more next to it.
BundleScene copies() {
  BundleScene scene = cloud("copies and near copies", {0, 0, 0}, 1, 0.2, 4);
  for (std::size_t i = 60; i < 300; ++i) scene.spheres[i] = scene.spheres[i % 60];
  for (std::size_t i = 180; i < 300; ++i) {
    float& z = scene.spheres[i].center.z;
    z = std::nextafter(z, i < 240 ? 9.0F : -9.0F);
  }
  return scene;
}

BundleScene on_the_ground() {
  BundleScene scene = cloud("on a ground sphere, inside another", {0, 0.3, 0}, 0.5, 0.1, 3);
  scene.spheres.push_back({{0, -1e6F, 0}, 1e6F, 0});
  scene.spheres.push_back({{0, 0, 0}, 1e3F, 0});
  scene.spheres.push_back({{0, 0, 3.01F}, 0.5F, 0});
  return scene;
}

/// Some that no float filter can judge.
BundleScene with_degenerates() {
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

std::vector<BundleScene> scenes() {
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
int even_bits(int i) {
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

Tile aim(CaseRandom& random, const BundleScene& scene) {
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
void shorten(CaseRandom& random, double until, std::vector<Ray>& rays) {
  if (!random.chance(0.25)) return;
  for (Ray& ray : rays) ray.tmax = static_cast<float>(until * random.uniform(0.9, 1.1));
}

std::vector<Ray> from_one_origin(const Tile& tile, const Vec3d& eye) {
  std::vector<Ray> rays;
  for (int i = 0; i < tile.rays(); ++i) {
    const Vec3d to = tile.target(i) - eye;
    rays.push_back({eye, vec_cast<float>(to * (tile.length / length(to)))});
  }
  return rays;
}

std::vector<Ray> in_one_direction(const Tile& tile, const Vec3d& eye) {
  const Vec3f dir = vec_cast<float>(normalize(tile.middle - eye) * tile.length);
  std::vector<Ray> rays;
  for (int i = 0; i < tile.rays(); ++i) rays.push_back({eye + tile.offset(i), dir});
  return rays;
}

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

bool judgeable(const Tile& tile) {
  return length(tile.middle) < 1e15 && length(tile.right) > 0;  // NaN is neither
}

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
  std::size_t met = 0;
};

TEST_P(Bundle, GivesTheScalarPathsAnswers) {
  for (const BundleScene& scene : scenes()) {
    for (const Structure structure : {Structure::scan, Structure::bvh}) {
      const Geometry geometry(scene.spheres, {}, structure);
      CaseRandom random(62);
      met = 0;
      constexpr int tiles = 24;
      for (int k = 0; k < tiles; ++k) {
        Tile tile = aim(random, scene);
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

TEST_P(Bundle, FindsShadows) {
  for (const BundleScene& scene : scenes()) {
    const Geometry geometry(scene.spheres, {});
    CaseRandom random(66);
    std::size_t rays = 0;
    met = 0;
    for (int k = 0; k < 40; ++k) {
      const Tile tile = aim(random, scene);
      if (!judgeable(tile)) continue;
      const std::vector<Ray> camera_rays = from_one_origin(tile, scene.eye);
      // Near the eye, behind the spheres, among them; or where a sphere's rim is in the way.
      const double away = length(tile.middle - scene.eye) * random.decade(-2, 2);
      const Vec3d from = random.chance(0.5) ? scene.eye : tile.middle;
      Vec3d light = from + random.direction() * away;
      const Tile other = aim(random, scene);
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

/// Rays from all over the place and from spheres, towards one point or in one direction.
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

/// Rays that have little in common with their neighbours in the stream are sorted, a pool at a
/// time; among many spheres they are few for each.
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

TEST_P(Bundle, MeetsPlanesAsWell) {
  const BundleScene scene = cloud("over a floor", {0, 0, 0}, 1, 0.1, 5);
  const std::vector<Plane> planes = {{{0, -0.5F, 0}, {0, 1, 0}, 0}, {{0, 0, -3}, {0, 0.1F, 1}, 0}};
  const Geometry geometry(scene.spheres, planes), floor_only({}, planes);
  CaseRandom random(63);
  for (int k = 0; k < 20; ++k) {
    const Tile tile = aim(random, scene);
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
    wide = from_one_origin(aim(random, scene), scene.eye);
    wide[77].tmin = 2;
    wide[78].tmin = -9;
    wide[79].source = 5;
    wide[80].dir.z = std::nanf("");
    wide[200].tmax = std::nanf("");
    wide[201].tmax = -1;
    check(scene, {}, geometry, wide, Coherence::common_origin);
  }
}

/// Rays without an end, NaN, do not hide what the others meet: any ray of a group may be one.
TEST_P(Bundle, LeavesOutRaysOfNaN) {
  for (const BundleScene& scene : {cloud("outside", {0, 0, 0}, 1, 0.1, 5), on_the_ground()}) {
    const Geometry geometry(scene.spheres, {});
    CaseRandom random(69);
    for (int k = 0; k < 40; ++k) {
      const Tile tile = aim(random, scene);
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

/// The whole sphere around the eye, a hemisphere, backwards: no ray of a bundle may be lost at
/// where its bundle is split.
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
