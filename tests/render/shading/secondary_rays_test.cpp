// Secondary rays in large numbers: no ray meets the convex surface that it leaves, none gets lost
// inside a sphere, and none escapes from a closed room. BOULE_SECONDARY_HITS sets the size (`ctest
// -L long`: one million surface points and ten million bounces; by default few enough for every
// day).
#include <cstdio>

#include "core/optics/dielectric.h"
#include "core/surface.h"
#include "tests/render/prepared.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/test_size.h"

namespace boule::test {
namespace {

constexpr std::size_t directions = 1000;

std::size_t surface_points() { return test_size("BOULE_SECONDARY_HITS", 20'000); }

/// A sphere whose centre lies `far` from the origin, and how far from it the eye is.
struct Place {
  const char* name;
  Sphere (*sphere)(CaseRandom& random);
  double (*distance)(CaseRandom& random, double radius);  ///< of the eye from the centre
};

Sphere sphere_at(CaseRandom& random, double far, double radius) {
  const Vec3d at = random.direction() * far;
  return {vec_cast<float>(at), static_cast<float>(radius), 0};
}
double near_by(CaseRandom& random, double radius) { return radius * random.uniform(1.1, 30); }

const Place places[] = {
    {"radii 1e-4 .. 1e4",
     [](CaseRandom& random) {
       const double radius = random.decade(-4, 4);
       const double far = radius * random.uniform(0, 5);
       return sphere_at(random, far, radius);
     },
     near_by},
    {"ground 1e2 .. 1e7, eye within 5 units",
     [](CaseRandom& random) {
       const double radius = random.decade(2, 7);
       return sphere_at(random, radius, radius);
     },
     [](CaseRandom& random, double radius) { return radius + random.uniform(0.01, 5); }},
    {"eye 1e4 .. 1e6 radii away",
     [](CaseRandom& random) {
       const double radius = random.uniform(0.5, 2);
       return sphere_at(random, 5, radius);
     },
     [](CaseRandom& random, double radius) { return radius * random.decade(4, 6); }},
    {"1e5 from the world's origin",
     [](CaseRandom& random) {
       const double radius = random.uniform(0.5, 2);
       return sphere_at(random, 1e5, radius);
     },
     near_by},
    {"1e7 from the world's origin",
     [](CaseRandom& random) {
       const double radius = random.uniform(5, 20);
       return sphere_at(random, 1e7, radius);
     },
     near_by},
};

/// From the eye to a random point of the visible half.
Ray primary(CaseRandom& random, const Sphere& sphere, const Vec3d& eye) {
  const Vec3d center = vec_cast<double>(sphere.center);
  Vec3d on = random.direction();
  if (dot(on, eye - center) < 0) on = -on;
  const Vec3d target = center + on * double{sphere.radius};
  const Vec3d org = vec_cast<double>(vec_cast<float>(eye));
  return {org, vec_cast<float>(normalize(target - org))};
}

/// Rays that leave a surface point, by the side to which they must go.
struct Leaving {
  std::vector<Ray> outward;  ///< reflected, scattered and shadow rays, and those that leave again
  std::vector<Ray> inward;   ///< refracted and scattered
};

Vec3d on_side(const Vec3d& direction, const Vec3d& normal) {
  return dot(direction, normal) < 0 ? -direction : direction;
}

void leave_outside(CaseRandom& random, const Surface& surface, Leaving& out) {
  const Vec3d scattered = on_side(random.direction(), surface.normal);
  const Vec3d light = surface.point + on_side(random.direction(), surface.normal) * surface.reach;
  const Refraction bent = refract(surface.view, surface.normal, surface.cosine, 1 / 1.5);
  out.outward.push_back(leave(surface, Side::viewer, surface.mirrored));
  out.outward.push_back(leave(surface, Side::viewer, scattered));
  out.outward.push_back(shadow_ray_to(surface, light));
  out.inward.push_back(leave(surface, Side::beyond, bent.direction));
  out.inward.push_back(leave(surface, Side::beyond, -scattered));
}

struct Count {
  std::size_t rays = 0, self_hits = 0, lost = 0;
};

/// All rays that leave one sphere. The kernels check them.
void check_sphere(CaseRandom& random, const Place& place, Count& count) {
  const Sphere sphere = place.sphere(random);
  const PreparedScene scene = prepared({sphere}, {});
  const KernelTable& kernels = *select_kernels("auto").value();
  const auto trace = [&](const std::vector<Ray>& rays) {
    return run_closest(kernels, scene.geometry.view(), rays, {});
  };
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < directions; ++i) {
    const double distance = place.distance(random, sphere.radius);
    const Vec3d eye = vec_cast<double>(sphere.center) + random.direction() * distance;
    rays.push_back(primary(random, sphere, eye));
  }
  Leaving first, second;
  const auto hits = trace(rays);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].id != 0) continue;
    const Surface surface = find_surface(scene, rays[i], hits[i]);
    if (!surface.inner) leave_outside(random, surface, first);  // rounding may put the eye inside
  }
  const auto inner = trace(first.inward);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (inner[i].id != 0) {
      ++count.lost;
      continue;
    }
    const Surface surface = find_surface(scene, first.inward[i], inner[i]);
    const Vec3d scattered = on_side(random.direction(), surface.normal);
    second.inward.push_back(leave(surface, Side::viewer, surface.mirrored));
    second.outward.push_back(leave(surface, Side::beyond, -scattered));
  }
  for (const Hit& hit : trace(second.inward)) count.lost += hit.id != 0 ? 1U : 0U;
  for (const std::vector<Ray>* out : {&first.outward, &second.outward}) {
    for (const Hit& hit : trace(*out)) count.self_hits += hit.id == 0 ? 1U : 0U;
    count.rays += out->size();
  }
  count.rays += first.inward.size() + second.inward.size();
}

TEST(SecondaryRays, NeverHitTheirSurfaceOrGetLost) {
  const std::size_t spheres = surface_points() / directions;
  std::size_t all_rays = 0;
  for (const Place& place : places) {
    Count count;
    for (std::size_t i = 0; i < spheres; ++i) {
      CaseRandom random(301, i);
      check_sphere(random, place, count);
    }
    std::printf("%-40s %9zu rays, %zu self-hits, %zu lost\n", place.name, count.rays,
                count.self_hits, count.lost);
    EXPECT_EQ(count.self_hits, 0U) << place.name;
    EXPECT_EQ(count.lost, 0U) << place.name;
    EXPECT_GT(count.rays, 2 * spheres * directions) << place.name;
    all_rays += count.rays;
  }
  EXPECT_GT(all_rays, 4 * surface_points());
}

/// A closed room that no ray can leave; holds() tells whether a point lies within its walls.
struct Room {
  const char* name;
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  Vec3d eye;
  bool (*holds)(const Vec3d& point);
};

std::vector<Plane> box(float half) {
  return {{{half, 0, 0}, {-1, 0, 0}, 0}, {{-half, 0, 0}, {1, 0, 0}, 0},
          {{0, half, 0}, {0, -1, 0}, 0}, {{0, -half, 0}, {0, 1, 0}, 0},
          {{0, 0, half}, {0, 0, -1}, 0}, {{0, 0, -half}, {0, 0, 1}, 0}};
}

const Room rooms[] = {
    {"a box with a sphere",
     {{{1, -6, 2}, 4, 0}},
     box(10),
     {-5, 5, 5},
     [](const Vec3d& p) {
       constexpr double edge = 10 + 1e-12;
       return std::fabs(p.x) <= edge && std::fabs(p.y) <= edge && std::fabs(p.z) <= edge;
     }},
    {"a hollow sphere with spheres",
     {{{0, 0, 0}, 10, 0}, {{5, 0, 0}, 4, 0}, {{-3, 2, 1}, 2, 0}},
     {},
     {0, 8, 0},
     [](const Vec3d& p) { return length(p) <= 10 + 1e-12; }},
    {"a ball of radius 1e5 far off, seen from inside",
     {{{1e6f, 0, 0}, 1e5f, 0}},
     {},
     {1e6, 5, 7},
     [](const Vec3d& p) {
       return length(p - Vec3d{1e6, 0, 0}) <= 1e5 + 1e-8;
     }},
};

/// Rays that bounce about: each goes on from its hit in a random direction of that side.
TEST(SecondaryRays, NeverEscapeFromAClosedRoom) {
  constexpr std::size_t walkers = 2000;
  const std::size_t steps = 10 * surface_points() / walkers / std::size(rooms) + 1;
  const KernelTable& kernels = *select_kernels("auto").value();
  for (const Room& room : rooms) {
    const PreparedScene scene = prepared(room.spheres, room.planes);
    CaseRandom random(302);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < walkers; ++i)
      rays.push_back({room.eye, vec_cast<float>(random.direction())});
    std::size_t escapes = 0, bounces = 0;
    for (std::size_t step = 0; step < steps && escapes == 0; ++step) {
      const auto hits = run_closest(kernels, scene.geometry.view(), rays, {});
      for (std::size_t i = 0; i < walkers; ++i, ++bounces) {
        if (hits[i].id == no_primitive) {
          ++escapes;
          continue;
        }
        const Surface surface = find_surface(scene, rays[i], hits[i]);
        escapes += room.holds(surface.point) ? 0U : 1U;
        rays[i] = leave(surface, Side::viewer, on_side(random.direction(), surface.normal));
      }
    }
    std::printf("%-46s %9zu bounces, %zu escapes\n", room.name, bounces, escapes);
    EXPECT_EQ(escapes, 0U) << room.name;
  }
}

}  // namespace
}  // namespace boule::test
