// Packets of rays that begin together and part: soon few of a packet's rays are left in a box, and
// they are tested one by one. The answers are the scalar path's. No ray has hits behind its origin:
// with one that has, a packet never tests its rays one by one.
#include <cmath>
#include <optional>
#include <vector>

#include "core/surface.h"
#include "tests/support/kernel_runs.h"
#include "tests/support/placed_groups.h"

namespace boule::test {
namespace {

PlacedGroups one_group(const std::string& name, std::vector<Sphere> spheres) {
  return {name, {std::move(spheres)}, {{0, std::nullopt}}};
}

/// Few spheres with many copies each: a leaf's box is that of one sphere, and equal t go to the
/// lower id.
std::vector<Sphere> copies(CaseRandom& random) {
  std::vector<Sphere> spheres = cube_of_spheres(random, 20, {}, 1, 0.3);
  for (std::size_t i = 20; i < 700; ++i) spheres.push_back(spheres[i % 20]);
  return spheres;
}

/// The last ones of those that are scanned are beyond the range of the filters.
std::vector<Sphere> few_and_giants(CaseRandom& random, const std::vector<Sphere>& giants) {
  std::vector<Sphere> spheres = cube_of_spheres(random, 15, {}, 1, 0.3);
  spheres.insert(spheres.end(), giants.begin(), giants.end());
  return spheres;
}

PlacedGroups parts(CaseRandom& random, const std::string& name, double scale) {
  PlacedGroups scene{name, {cube_of_spheres(random, 200, {}, 1, 0.15)}, {}};
  scene.groups[0].push_back({{0, -0.5F, 0}, 0.6F, 0});  // in no leaf
  for (int i = 0; i < 6; ++i) {
    Similarity transform = random_placement(random, scale, 1);
    transform.shift = transform.shift * scale;
    scene.places.push_back({0, transform});
  }
  return scene;
}

std::vector<PlacedGroups> scenes() {
  CaseRandom random(61);
  return {
      one_group("a tree of one node", cube_of_spheres(random, 120, {}, 1, 0.2)),
      one_group("a cloud", cube_of_spheres(random, 1500, {}, 1, 0.08)),
      one_group("a cloud far from the origin",
                cube_of_spheres(random, 1500, {1e5, -1e5, 1e5}, 10, 1)),
      one_group("copies", copies(random)),
      parts(random, "parts", 1),
      parts(random, "parts beyond the range of the filters", 1e22),
      one_group("few, which are scanned", cube_of_spheres(random, 37, {}, 1, 0.25)),
      one_group("few, far from the origin", cube_of_spheres(random, 16, {1e5, -1e5, 1e5}, 10, 3)),
      one_group("few, one of which is everywhere",
                few_and_giants(random, {{{0, -1e20F, 0}, 1e20F, 0}})),
      one_group("few, and some that are no spheres",
                few_and_giants(random, {{{0, std::nanf(""), 0}, 1, 0},
                                        {{1, 0, 0}, std::nanf(""), 0},
                                        {{0, 0, HUGE_VALF}, 1, 0},
                                        {{0, 3e38F, 0}, 2e38F, 0}}))};
}

/// Any sphere that is one.
const Sphere& any_of(CaseRandom& random, const std::vector<Sphere>& spheres) {
  for (;;) {
    const Sphere& sphere =
        spheres[static_cast<std::size_t>(random.below(static_cast<int>(spheres.size())))];
    if (is_finite(sphere.center) && std::isfinite(sphere.radius)) return sphere;
  }
}

/// From an eye to just within or just beside the rim of some sphere.
Vec3d to_a_rim(CaseRandom& random, const std::vector<Sphere>& spheres, const Vec3d& eye) {
  const Sphere& sphere = any_of(random, spheres);
  const Vec3d center = vec_cast<double>(sphere.center);
  const double beta = 1 + random.sign() * random.decade(-8, -0.5);
  const Vec3d side = random.perpendicular(normalize(center - eye));
  return center + side * (beta * double{sphere.radius}) - eye;
}

/// Two packets of up to sixteen rays at a time that begin near one another, every other time on a
/// surface, every fourth time near the origin, and go towards the rims of spheres anywhere. Many
/// end near the rim, or far before it; of those that begin on a surface, all: they are short, and
/// both packets share their way where any hit will do.
std::vector<Ray> parting_rays(const std::vector<Sphere>& spheres, int pairs) {
  CaseRandom random(62);
  std::vector<Ray> rays;
  for (int i = 0; i < pairs; ++i) {
    const Sphere& near = any_of(random, spheres);
    const double radius{near.radius};
    const bool is_central = i % 4 == 1;
    const double apart = 0.05 * (is_central ? 1 : radius);
    const Vec3d eye = is_central
                          ? random.direction()
                          : vec_cast<double>(near.center) + random.direction() * (1.5 * radius);
    for (int k = 0; k < 32; ++k) {
      const Vec3d org = eye + random.direction() * apart;
      Ray ray{org, vec_cast<float>(to_a_rim(random, spheres, org))};
      const Hit hit = reference::closest_hit(ray, spheres, {});
      if (i % 2 == 0) {
        if (hit.id != no_primitive) {
          const Surface surface = find_surface(spheres, {}, ray, hit);
          ray = leave(surface, k % 3 == 0 ? Side::beyond : Side::viewer,
                      normalize(to_a_rim(random, spheres, surface.point)));
        }
        ray.tmax = static_cast<float>(radius * random.decade(-1, 2));
      } else if (i % 3 != 0) {
        ray.tmax = static_cast<float>(i % 3 == 1 ? random.uniform(0.8, 1.2) : random.decade(-2, 0));
      }
      rays.push_back(ray);
    }
  }
  return rays;
}

class PartingPackets : public OnEachIsa {};

TEST_P(PartingPackets, EqualTheScalarPath) {
  for (const PlacedGroups& scene : scenes()) {
    const std::vector<Sphere> all = scene.written_out();
    const std::vector<Ray> rays = parting_rays(all, 60);
    const bool is_whole = scene.places.size() == 1;
    const Geometry geometry = is_whole ? Geometry(all, {}) : scene.in_parts({}, Structure::bvh);
    std::vector<Hit> expected;
    std::size_t met = 0;
    for (const Ray& ray : rays) {
      ASSERT_GE(ray.tmin, 0) << scene.name;
      expected.push_back(reference::closest_hit(ray, all, {}));
      met += expected.back().id != no_primitive ? 1U : 0U;
    }
    EXPECT_GT(met, rays.size() / 10) << scene.name;
    EXPECT_LT(met, rays.size() * 9 / 10) << scene.name;
    for (const Form form : {Form::packet, Form::flight, Form::set, Form::automatic}) {
      const Query query{Solver::robust, form, Coherence::none};
      const auto hits = run_closest(*kernels, geometry.view(), rays, query);
      const auto occluded = run_any(*kernels, geometry.view(), rays, query);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_TRUE(same_bits(hits[i], expected[i]))
            << scene.name << " ray " << i << ": " << hits[i].id << " " << hits[i].t << ", expected "
            << expected[i].id << " " << expected[i].t;
        ASSERT_EQ(occluded[i], expected[i].id != no_primitive ? 1 : 0) << scene.name << " " << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, PartingPackets, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
