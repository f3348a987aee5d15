#include "core/surface.h"
#include "render/shading/lights.h"

#include <gtest/gtest.h>

#include <bit>

#include "core/reference.h"
#include "render/prepare/prepared_scene.h"
#include "simd/dispatch/dispatch.h"
#include "tests/render/prepared.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

Surface hit_by(const PreparedScene& scene, const Ray& ray) {
  const Hit hit = reference::closest_hit(ray, scene.spheres, scene.planes);
  EXPECT_NE(hit.id, no_primitive);
  return find_surface(scene, ray, hit);
}

TEST(Surface, OfASphereSeenFromOutsideAndInside) {
  const PreparedScene scene = prepared({{{0, 0, 0}, 2, 0}}, {});
  const Surface outer = hit_by(scene, {{0, 0, 5}, {0, 0, -3}});
  EXPECT_EQ(outer.point, (Vec3d{0, 0, 2}));
  EXPECT_EQ(outer.normal, (Vec3d{0, 0, 1}));
  EXPECT_EQ(outer.view, (Vec3d{0, 0, -1}));
  EXPECT_EQ(outer.mirrored, (Vec3d{0, 0, 1}));
  EXPECT_EQ(outer.cosine, 1);
  EXPECT_EQ(outer.reach, 7);
  EXPECT_TRUE(outer.sphere && !outer.inner);
  const Surface inner = hit_by(scene, {{0, 0, 1}, {0, 0, 0.5f}});
  EXPECT_EQ(inner.point, (Vec3d{0, 0, 2}));
  EXPECT_EQ(inner.normal, (Vec3d{0, 0, -1}));
  EXPECT_TRUE(inner.inner);
}

TEST(Surface, OfAPlaneSeenFromBothSides) {
  const PreparedScene scene = prepared({}, {{{0, 1, 0}, {0, 4, 0}, 0}});
  const Surface above = hit_by(scene, {{0, 3, 0}, {0, -1, 0}});
  EXPECT_EQ(above.point, (Vec3d{0, 1, 0}));
  EXPECT_EQ(above.normal, (Vec3d{0, 1, 0}));
  EXPECT_TRUE(!above.sphere && !above.inner);
  const Surface below = hit_by(scene, {{0, -3, 0}, {0, 1, 0}});
  EXPECT_EQ(below.normal, (Vec3d{0, -1, 0}));
  EXPECT_TRUE(below.inner);
}

TEST(Surface, RaysThatLeaveItKnowTheirSourceAndSide) {
  struct Case {
    bool sphere, from_inside;
    Side side;
    bool inside;  ///< Ray::inside of the ray that leaves
  };
  const Case cases[] = {{true, false, Side::viewer, false},  {true, false, Side::beyond, true},
                        {true, true, Side::viewer, true},    {true, true, Side::beyond, false},
                        {false, false, Side::viewer, false}, {false, false, Side::beyond, false},
                        {false, true, Side::viewer, false},  {false, true, Side::beyond, false}};
  const PreparedScene ball = prepared({{{0, 0, 0}, 2, 0}}, {});
  const PreparedScene wall = prepared({}, {{{0, 0, 2}, {0, 0, 1}, 0}});
  for (const Case& c : cases) {
    const Ray in = c.from_inside ? Ray{{0, 0, 0}, {0, 0, 1}} : Ray{{0, 0, 7}, {0, 0, -1}};
    const Surface surface = hit_by(c.sphere ? ball : wall, in);
    EXPECT_EQ(surface.inner, c.from_inside);
    const Ray out = leave(surface, c.side, {0, 0.6, 0.8});
    EXPECT_EQ(out.source, 0);
    EXPECT_EQ(out.inside, c.inside);
    EXPECT_EQ(out.dir, (Vec3f{0, 0.6f, 0.8f}));
    EXPECT_EQ(out.tmin, 0);
    EXPECT_EQ(out.tmax, std::numeric_limits<float>::infinity());
    const double sign = c.side == Side::viewer ? 1 : -1;
    EXPECT_GT(sign * dot(out.org - surface.point, surface.normal), 0);
    EXPECT_LE(length(out.org - surface.point), 0x1p-48 * surface.reach);
  }
}

TEST(Surface, ShadowRaysEndBeforeTheLight) {
  const PreparedScene scene = prepared({{{0, 0, 0}, 1, 0}}, {});
  const Surface surface = hit_by(scene, {{0, 0, 5}, {0, 0, -1}});
  const Ray ray = shadow_ray_to(surface, {0, 3, 1});
  EXPECT_EQ(ray.dir.x, 0);
  EXPECT_EQ(ray.dir.y, 3);
  EXPECT_NEAR(ray.dir.z, 0, 0x1p-45);  // by so much the origin was moved
  EXPECT_EQ(ray.tmax, 1 - 0x1p-22f);
  EXPECT_EQ(ray.source, 0);
  EXPECT_FALSE(ray.inside);
}

TEST(Surface, ASphereTooSmallForItsPlaceHasANormal) {
  // p - c is exactly 0 here, and gives no direction.
  const PreparedScene scene = prepared({{{1, 1, 1}, 1e-30f, 0}}, {});
  const Ray ray{{1, 1, 5}, {0, 0, -1}};
  const Surface surface = hit_by(scene, ray);
  EXPECT_EQ(surface.normal, (Vec3d{0, 0, 1}));
  EXPECT_TRUE(is_finite(surface.mirrored));
  EXPECT_EQ(surface.cosine, 1);
}

/// A random ray that starts near the scene and meets something.
struct Bounce {
  Surface surface;
  Vec3d scattered;  ///< unit, on the viewer's side
};
std::vector<Bounce> bounces(const PreparedScene& scene, const Vec3d& eye, double spread,
                            std::uint64_t seed) {
  std::vector<Bounce> found;
  CaseRandom random(seed);
  for (int tries = 0; tries < 20000 && found.size() < 3000; ++tries) {
    const Vec3d from = eye + random.direction() * spread;
    const Ray ray{vec_cast<double>(vec_cast<float>(from)), vec_cast<float>(random.direction())};
    const Vec3d scattered = random.direction();
    const Hit hit = reference::closest_hit(ray, scene.spheres, scene.planes);
    if (hit.id == no_primitive) continue;
    const Surface surface = find_surface(scene, ray, hit);
    const double side = dot(scattered, surface.normal);
    if (std::fabs(side) < 1e-6) continue;
    found.push_back({surface, side > 0 ? scattered : -scattered});
  }
  return found;
}

struct Place {
  const char* name;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  Vec3d eye;
  double spread;
};

std::vector<Place> places() {
  std::vector<Place> list;
  list.push_back({"ordinary", {{{0, 0, 0}, 1, 0}}, {}, {0, 0, 3}, 1.5});
  list.push_back({"inside", {{{0, 0, 0}, 1, 0}}, {}, {0, 0, 0}, 0.5});
  list.push_back({"plane", {}, {{{0, 0, 0}, {0.1f, 1, 0.2f}, 0}}, {0, 3, 0}, 2});
  for (const float r : {1e2f, 1e4f, 1e6f}) {
    list.push_back({"ground", {{{0, -r, 0}, r, 0}}, {}, {0, 3, 0}, 2});
  }
  list.push_back({"distant", {{{0, 0, -1e5f}, 3e4f, 0}}, {}, {0, 0, 0}, 1});
  list.push_back({"far off", {{{1e5f, 1e5f, 1e5f}, 1, 0}}, {}, {1e5, 1e5, 1e5 + 3}, 1.5});
  list.push_back({"tiny", {{{0, 0, 0}, 1e-6f, 0}}, {}, {0, 0, 3e-6}, 1e-6});
  return list;
}

/// With the kernels of the best ISA and with the reference, no ray meets its source again.
TEST(Surface, ReflectedAndShadowRaysNeverMeetAConvexSourceAgain) {
  for (const Place& place : places()) {
    const PreparedScene scene = prepared(place.spheres, place.planes);
    std::vector<Ray> rays;
    for (const Bounce& b : bounces(scene, place.eye, place.spread, 11)) {
      const bool leaves_inside = b.surface.sphere && b.surface.inner;
      const Side side = leaves_inside ? Side::beyond : Side::viewer;
      const Vec3d direction = leaves_inside ? -b.scattered : b.scattered;
      rays.push_back(leave(b.surface, side, direction));
      if (!leaves_inside) {
        rays.push_back(shadow_ray_to(b.surface, b.surface.point + b.scattered * 10.0));
      }
    }
    ASSERT_GT(rays.size(), 300u) << place.name;
    for (const KernelTable* kernels : {select_kernels("auto").value(), &reference_kernels()}) {
      for (const Hit& hit : run_closest(*kernels, scene.geometry.view(), rays, {})) {
        ASSERT_EQ(hit.id, no_primitive) << place.name;
      }
      for (const int occluded : run_any(*kernels, scene.geometry.view(), rays, {})) {
        ASSERT_EQ(occluded, 0) << place.name;
      }
    }
  }
}

/// A ray on the inside crosses the sphere: it does not leak, and does not meet the sphere at its
/// start.
TEST(Surface, RaysThatGoInsideMeetTheFarSide) {
  for (const Place& place : places()) {
    if (place.spheres.empty()) continue;
    const PreparedScene scene = prepared(place.spheres, place.planes);
    std::vector<Ray> rays;
    std::vector<double> chords;
    for (const Bounce& b : bounces(scene, place.eye, place.spread, 12)) {
      const Side side = b.surface.inner ? Side::viewer : Side::beyond;
      const Vec3d direction = b.surface.inner ? b.scattered : -b.scattered;
      rays.push_back(leave(b.surface, side, direction));
      chords.push_back(2 * static_cast<double>(place.spheres[0].radius) *
                       std::fabs(dot(direction, b.surface.normal)));
    }
    const auto hits = run_closest(*select_kernels("auto").value(), scene.geometry.view(), rays, {});
    ASSERT_GT(hits.size(), 300u) << place.name;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      ASSERT_EQ(hits[k].id, 0) << place.name;
      // The direction is float, so the chord is known to 6e-8 of the diameter only.
      ASSERT_NEAR(hits[k].t, chords[k], 4e-7 * static_cast<double>(place.spheres[0].radius))
          << place.name;
    }
  }
}

/// Two surfaces that touch: what is right behind one of them is not seen through it.
TEST(Surface, ReflectedRaysDoNotPassThroughASphereInContact) {
  // Two spheres have the same points. A ray that leaves one of them to the outside has left both.
  const PreparedScene scene = prepared({{{3, 2, 1}, 1, 0}, {{3, 2, 1}, 1, 0}}, {});
  std::vector<Ray> rays;
  for (const Bounce& b : bounces(scene, {3, 2, 4}, 1, 13)) {
    rays.push_back(leave(b.surface, Side::viewer, b.scattered));
  }
  ASSERT_GT(rays.size(), 300u);
  for (const Hit& hit :
       run_closest(*select_kernels("auto").value(), scene.geometry.view(), rays, {})) {
    ASSERT_EQ(hit.id, no_primitive);
  }
}

}  // namespace
}  // namespace boule::test
