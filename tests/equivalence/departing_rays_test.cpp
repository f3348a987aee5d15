// Rays that leave a surface do not meet it again, and do not get lost inside it.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/math/geometry.h"
#include "core/reference.h"
#include "core/surface.h"
#include "simd/dispatch/dispatch.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"

namespace boule::test::departing_rays {
namespace {

/// The primitives that rays may meet.
struct Primitives {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
};

/// A random ray that starts near the scene and meets something.
struct Bounce {
  Surface surface;
  Vec3d scattered;  ///< unit, on the viewer's side
};
std::vector<Bounce> bounces(const Primitives& scene, const Vec3d& eye, double spread,
                            std::uint64_t seed) {
  std::vector<Bounce> found;
  CaseRandom random(seed);
  for (int tries = 0; tries < 20000 && found.size() < 3000; ++tries) {
    const Vec3d from = eye + random.direction() * spread;
    const Ray ray{vec_cast<double>(vec_cast<float>(from)), vec_cast<float>(random.direction())};
    const Vec3d scattered = random.direction();
    const Hit hit = reference::closest_hit(ray, scene.spheres, scene.planes);
    if (hit.id == no_primitive) continue;
    const Surface surface = find_surface(scene.spheres, scene.planes, ray, hit);
    const double side = dot(scattered, surface.normal);
    if (std::fabs(side) < 1e-6) continue;
    found.push_back({surface, side > 0 ? scattered : -scattered});
  }
  return found;
}

struct Viewpoint {
  const char* name;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  Vec3d eye;
  double spread;
};

std::vector<Viewpoint> viewpoints() {
  std::vector<Viewpoint> list;
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
TEST(DepartingRays, OutwardRaysMissTheirConvexSource) {
  for (const Viewpoint& from : viewpoints()) {
    const Geometry geometry(from.spheres, from.planes);
    const Primitives scene{from.spheres, from.planes};
    std::vector<Ray> rays;
    for (const Bounce& b : bounces(scene, from.eye, from.spread, 11)) {
      const bool leaves_inside = b.surface.solid && b.surface.inner;
      const Side side = leaves_inside ? Side::beyond : Side::viewer;
      const Vec3d direction = leaves_inside ? -b.scattered : b.scattered;
      rays.push_back(leave(b.surface, side, direction));
      if (!leaves_inside) {
        rays.push_back(shadow_ray_to(b.surface, b.surface.point + b.scattered * 10.0));
      }
    }
    ASSERT_GT(rays.size(), 300u) << from.name;
    for (const KernelTable* kernels : {select_kernels("auto").value(), &reference_kernels()}) {
      for (const Hit& hit : run_closest(*kernels, geometry.view(), rays, {})) {
        ASSERT_EQ(hit.id, no_primitive) << from.name;
      }
      for (const int occluded : run_any(*kernels, geometry.view(), rays, {})) {
        ASSERT_EQ(occluded, 0) << from.name;
      }
    }
  }
}

/// A ray on the inside crosses the sphere: it does not leak, and does not meet the sphere at its
/// start.
TEST(DepartingRays, InwardRaysMeetTheFarSide) {
  for (const Viewpoint& from : viewpoints()) {
    if (from.spheres.empty()) continue;
    const Geometry geometry(from.spheres, from.planes);
    const Primitives scene{from.spheres, from.planes};
    std::vector<Ray> rays;
    std::vector<double> chords;
    for (const Bounce& b : bounces(scene, from.eye, from.spread, 12)) {
      const Side side = b.surface.inner ? Side::viewer : Side::beyond;
      const Vec3d direction = b.surface.inner ? b.scattered : -b.scattered;
      rays.push_back(leave(b.surface, side, direction));
      chords.push_back(2 * static_cast<double>(from.spheres[0].radius) *
                       std::fabs(dot(direction, b.surface.normal)));
    }
    const auto hits = run_closest(*select_kernels("auto").value(), geometry.view(), rays, {});
    ASSERT_GT(hits.size(), 300u) << from.name;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      ASSERT_EQ(hits[k].id, 0) << from.name;
      // The direction is float, so the chord is known to 6e-8 of the diameter only.
      ASSERT_NEAR(hits[k].t, chords[k], 4e-7 * static_cast<double>(from.spheres[0].radius))
          << from.name;
    }
  }
}

/// Two surfaces that touch: what is right behind one of them is not seen through it.
TEST(DepartingRays, ReflectedRaysHitSpheresInContact) {
  // Two spheres have the same points. A ray that leaves one of them to the outside has left both.
  const Primitives scene{{{{3, 2, 1}, 1, 0}, {{3, 2, 1}, 1, 0}}, {}};
  const Geometry geometry(scene.spheres, scene.planes);
  std::vector<Ray> rays;
  for (const Bounce& b : bounces(scene, {3, 2, 4}, 1, 13)) {
    rays.push_back(leave(b.surface, Side::viewer, b.scattered));
  }
  ASSERT_GT(rays.size(), 300u);
  for (const Hit& hit : run_closest(*select_kernels("auto").value(), geometry.view(), rays, {})) {
    ASSERT_EQ(hit.id, no_primitive);
  }
}

}  // namespace
}  // namespace boule::test::departing_rays
