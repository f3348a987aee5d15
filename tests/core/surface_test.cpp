#include "core/surface.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/math/geometry.h"
#include "core/reference.h"

namespace boule::test {
namespace {

/// The primitives that rays may meet.
struct Primitives {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
};

Surface hit_by(const Primitives& scene, const Ray& ray) {
  const Hit hit = reference::closest_hit(ray, scene.spheres, scene.planes);
  EXPECT_NE(hit.id, no_primitive);
  return find_surface(scene.spheres, scene.planes, ray, hit);
}

TEST(Surface, SphereSurfacesFaceTheViewer) {
  const Primitives scene{{{{0, 0, 0}, 2, 0}}, {}};
  const Surface outer = hit_by(scene, {{0, 0, 5}, {0, 0, -3}});
  EXPECT_EQ(outer.point, (Vec3d{0, 0, 2}));
  EXPECT_EQ(outer.normal, (Vec3d{0, 0, 1}));
  EXPECT_EQ(outer.view, (Vec3d{0, 0, -1}));
  EXPECT_EQ(outer.mirrored, (Vec3d{0, 0, 1}));
  EXPECT_EQ(outer.cosine, 1);
  EXPECT_EQ(outer.reach, 7);
  EXPECT_TRUE(outer.solid && !outer.inner);
  const Surface inner = hit_by(scene, {{0, 0, 1}, {0, 0, 0.5f}});
  EXPECT_EQ(inner.point, (Vec3d{0, 0, 2}));
  EXPECT_EQ(inner.normal, (Vec3d{0, 0, -1}));
  EXPECT_TRUE(inner.inner);
}

TEST(Surface, CapsuleSurfacesFaceTheViewer) {
  const Capsule capsule{{0, 0, 0}, {4, 0, 0}, 2, {}};
  const auto surface_met_by = [&capsule](const Ray& ray) {
    return find_surface(capsule, ray, {reference::intersect(ray, capsule, false), 0});
  };
  const Surface tube = surface_met_by({{1, 0, 5}, {0, 0, -3}});
  EXPECT_EQ(tube.point, (Vec3d{1, 0, 2}));
  EXPECT_EQ(tube.normal, (Vec3d{0, 0, 1}));
  EXPECT_TRUE(tube.solid && !tube.inner);
  const Surface end = surface_met_by({{9, 0, 0}, {-1, 0, 0}});
  EXPECT_EQ(end.point, (Vec3d{6, 0, 0}));
  EXPECT_EQ(end.normal, (Vec3d{1, 0, 0}));
  const Surface inner = surface_met_by({{3, 1, 0}, {0, 0.5f, 0}});
  EXPECT_EQ(inner.point, (Vec3d{3, 2, 0}));
  EXPECT_EQ(inner.normal, (Vec3d{0, -1, 0}));
  EXPECT_TRUE(inner.solid && inner.inner);
}

TEST(Surface, PlaneSurfacesFaceTheViewer) {
  const Primitives scene{{}, {{{0, 1, 0}, {0, 4, 0}, 0}}};
  const Surface above = hit_by(scene, {{0, 3, 0}, {0, -1, 0}});
  EXPECT_EQ(above.point, (Vec3d{0, 1, 0}));
  EXPECT_EQ(above.normal, (Vec3d{0, 1, 0}));
  EXPECT_TRUE(!above.solid && !above.inner);
  const Surface below = hit_by(scene, {{0, -3, 0}, {0, 1, 0}});
  EXPECT_EQ(below.normal, (Vec3d{0, -1, 0}));
  EXPECT_TRUE(below.inner);
}

TEST(Surface, LeavingRaysKnowTheirSourceAndSide) {
  struct Case {
    bool sphere, from_inside;
    Side side;
    bool inside;  ///< Ray::inside of the ray that leaves
  };
  const Case cases[] = {{true, false, Side::viewer, false},  {true, false, Side::beyond, true},
                        {true, true, Side::viewer, true},    {true, true, Side::beyond, false},
                        {false, false, Side::viewer, false}, {false, false, Side::beyond, false},
                        {false, true, Side::viewer, false},  {false, true, Side::beyond, false}};
  const Primitives ball{{{{0, 0, 0}, 2, 0}}, {}};
  const Primitives wall{{}, {{{0, 0, 2}, {0, 0, 1}, 0}}};
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
  const Primitives scene{{{{0, 0, 0}, 1, 0}}, {}};
  const Surface surface = hit_by(scene, {{0, 0, 5}, {0, 0, -1}});
  const Ray ray = shadow_ray_to(surface, {0, 3, 1});
  EXPECT_EQ(ray.dir.x, 0);
  EXPECT_EQ(ray.dir.y, 3);
  EXPECT_NEAR(ray.dir.z, 0, 0x1p-45);  // by so much the origin was moved
  EXPECT_EQ(ray.tmax, 1 - 0x1p-22f);
  EXPECT_EQ(ray.source, 0);
  EXPECT_FALSE(ray.inside);
}

TEST(Surface, SpheresBelowFloatPrecisionHaveNormals) {
  // p - c is exactly 0 here, and gives no direction.
  const Primitives scene{{{{1, 1, 1}, 1e-30f, 0}}, {}};
  const Ray ray{{1, 1, 5}, {0, 0, -1}};
  const Surface surface = hit_by(scene, ray);
  EXPECT_EQ(surface.normal, (Vec3d{0, 0, 1}));
  EXPECT_TRUE(is_finite(surface.mirrored));
  EXPECT_EQ(surface.cosine, 1);
}

}  // namespace
}  // namespace boule::test
