// For each bound of bundles in filter_bounds.h scenes in which hits would be wrong without it
// (mutations.sh takes them away one by one).
#include <array>
#include <cmath>

#include "core/math/geometry.h"
#include "tests/support/case_random.h"
#include "tests/support/kernel_runs.h"

namespace boule::test {
namespace {

class BundleBounds : public OnEachIsa {
 protected:
  void check(const std::vector<Sphere>& spheres, const std::vector<Ray>& rays,
             Coherence coherence) {
    const Geometry geometry(spheres, {});
    const Query query{Solver::robust, Form::automatic, coherence};
    const auto occluded = run_any(*kernels, geometry.view(), rays, query);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit expected = reference::closest_hit(rays[i], spheres, {});
      ASSERT_EQ(occluded[i], expected.id < 0 ? 0 : 1) << "ray " << i;
      met += expected.id < 0 ? 0U : 1U;
    }
    all += rays.size();
    if (coherence == Coherence::common_end) return;
    const auto hits = run_closest(*kernels, geometry.view(), rays, query);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Hit expected = reference::closest_hit(rays[i], spheres, {});
      ASSERT_TRUE(same_bits(hits[i], expected))
          << "ray " << i << ": " << hits[i].id << " " << hits[i].t << ", expected " << expected.id
          << " " << expected.t;
    }
  }

  std::size_t all = 0, met = 0;
};

/// How far from its centre a sphere is met, in radii: near 1, on either side.
double near_rim(CaseRandom& random, double least, double most) {
  const double sign = random.sign();
  return 1 + sign * random.decade(least, most);
}

/// bundle_double: the rays of the bundle are all the same, so that nothing else is lost, and the
/// sphere is 4e10 to 4e12 times its radius away. It lies next to the world's origin, where floats
/// are dense.
TEST_P(BundleBounds, SpecksFarAway) {
  CaseRandom random(71);
  for (int trial = 0; trial < 400; ++trial) {
    const Vec3f dir = vec_cast<float>(random.direction());
    const Vec3d towards = normalize(vec_cast<double>(dir));
    const double r = random.decade(-11.9, -10);
    const Vec3d center = random.perpendicular(towards) * (r * near_rim(random, -6, -2));
    const Ray ray{vec_cast<double>(dir) * -random.uniform(3, 5), dir};
    check({{vec_cast<float>(center), static_cast<float>(r), 0}}, std::vector<Ray>(64, ray),
          Coherence::common_origin);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 3 / 4);
}

/// bundle_square: a narrow bundle along the rim of a large sphere.
TEST_P(BundleBounds, TheRimOfALargeSphere) {
  CaseRandom random(72);
  for (int trial = 0; trial < 200; ++trial) {
    const Sphere sphere{vec_cast<float>(random.direction() * random.uniform(0, 1)),
                        static_cast<float>(random.uniform(0.3, 1)), 0};
    const Vec3d center = vec_cast<double>(sphere.center);
    const Vec3d towards = random.direction(), side = random.perpendicular(towards);
    const Vec3d eye = center - towards * (double{sphere.radius} * random.uniform(2.5, 4));
    // Where the cone around the sphere touches it, or a cylinder.
    const double distance = length(center - eye), sine = double{sphere.radius} / distance;
    const double cosine = std::sqrt(1 - sine * sine);
    const double beta = near_rim(random, -9, -6);
    const Vec3d rim = side * (cosine * double{sphere.radius} * beta) -
                      towards * (sine * double{sphere.radius} * beta);
    std::vector<Ray> from_eye, parallel;
    for (int i = 0; i < 64; ++i) {
      const Vec3d off = random.direction() * 1e-7;
      from_eye.push_back({eye, vec_cast<float>(center + rim + off - eye)});
      const Vec3d start = eye + side * (beta * double{sphere.radius}) + off;
      parallel.push_back({start, vec_cast<float>(towards)});
    }
    check({sphere}, from_eye, Coherence::common_origin);
    check({sphere}, parallel, Coherence::common_direction);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 3 / 4);
}

/// bundle_shift_slope: the distance by which rays miss their light is a good part of the radius of
/// a small sphere close to the light. Among many spheres the rays are sorted first.
TEST_P(BundleBounds, SpecksAroundALight) {
  CaseRandom random(73);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3d light = random.direction() * 1e-3, back = random.direction();
    std::vector<Sphere> specks;
    double radius = 0;
    for (int i = 0; i < (trial % 2 == 0 ? 1 : 100); ++i) {
      const double away = random.decade(-4, -2), r = away * random.decade(-3, -1.5);
      const double rim = i == 0 ? near_rim(random, -6, -1) : random.uniform(1.5, 3);
      const Vec3d center = light + back * away + random.perpendicular(back) * (r * rim);
      specks.push_back({vec_cast<float>(center), static_cast<float>(r), 0});
      if (i == 0) radius = r;
    }
    std::vector<Ray> rays;
    for (int i = 0; i < 64; ++i) {
      const Vec3d org =
          light + back * random.uniform(0.5, 1) + random.direction() * (1e-3 * radius);
      Ray ray{org, vec_cast<float>(light - org)};
      ray.tmax = 1 - 0x1p-22F;
      rays.push_back(ray);
    }
    check(specks, rays, Coherence::common_end);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 3 / 4);
}

/// bundle_end: rays that end behind a speck, a million units from the world's origin, where a
/// double step is 1e-10. All rays are the same, so that their rounded ends do not show how far off
/// they are.
TEST_P(BundleBounds, EndsFarFromTheWorldsOrigin) {
  CaseRandom random(77);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3f center = vec_cast<float>(random.direction() * 2e6);
    const double r = random.decade(-7, -5);
    const Vec3d org = vec_cast<double>(center) + random.direction() * (r * random.uniform(3, 20));
    const Vec3d view = vec_cast<double>(center) - org;
    const double distance = length(view), sine = r / distance * near_rim(random, -5, -2);
    const Vec3d towards = view * (1 / distance), side = random.perpendicular(towards);
    const Vec3d dir = towards * std::sqrt(1 - sine * sine) + side * sine;
    Ray ray{org, vec_cast<float>(dir * (distance + r * random.uniform(3, 6)))};
    ray.tmax = 1 - 0x1p-22F;
    check({{center, static_cast<float>(r), 0}}, std::vector<Ray>(64, ray), Coherence::common_end);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 3 / 4);
}

/// bundle_end: rays from far away, which pass a sphere next to their end by no more than the error
/// of the double solver, which decides.
TEST_P(BundleBounds, EndsFarFromTheRaysOrigins) {
  CaseRandom random(79);
  for (int trial = 0; trial < 300; ++trial) {
    const double away = random.decade(-7, 1), far = away * random.decade(11, 13);
    const Vec3d back = random.direction();
    const double r = away * random.decade(-4, -0.8);
    const Sphere sphere{vec_cast<float>(back * away), static_cast<float>(r), 0};
    const Vec3d center = vec_cast<double>(sphere.center);
    const double distance = length(center);
    std::vector<Ray> rays;
    for (int i = 0; i < 64; ++i) {
      const Vec3d towards = center * (1 / distance), side = random.perpendicular(towards);
      const double sine = double{sphere.radius} / distance * near_rim(random, -5, -1);
      const Vec3f dir =
          vec_cast<float>((towards * std::sqrt(1 - sine * sine) + side * sine) * -far);
      rays.push_back({vec_cast<double>(dir) * -1.0, dir});
      rays.back().tmax = 1;
    }
    check({sphere}, rays, Coherence::common_end);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 3 / 4);
}

/// bundle_depth: rays that end where they meet a sphere, or next to it; parallel ones may begin far
/// from each other.
TEST_P(BundleBounds, EndsOnTheSurface) {
  CaseRandom random(74);
  for (int trial = 0; trial < 300; ++trial) {
    const Sphere sphere{vec_cast<float>(random.direction()),
                        static_cast<float>(random.uniform(0.1, 0.5)), 0};
    const Vec3d center = vec_cast<double>(sphere.center), towards = random.direction();
    const Vec3d eye = center - towards * random.uniform(2, 9);
    const double scale = random.decade(-3, 3);
    std::vector<Ray> from_eye, parallel;
    for (int i = 0; i < 64; ++i) {
      const Vec3d off = random.direction() * (0.9 * double{sphere.radius});
      from_eye.push_back({eye, vec_cast<float>((center + off - eye) * scale)});
      const double behind = random.decade(-1, 3);
      parallel.push_back({eye + off - towards * behind, vec_cast<float>(towards * scale)});
    }
    for (std::vector<Ray>* rays : {&from_eye, &parallel}) {
      for (Ray& ray : *rays) {
        const Hit hit = reference::closest_hit(ray, {&sphere, 1}, {});
        const float t = static_cast<float>(hit.id < 0 ? 1 : hit.t);
        ray.tmax = std::nextafter(t, random.chance(0.5) ? 2 * t : 0.0F);
      }
    }
    check({sphere}, from_eye, Coherence::common_origin);
    check({sphere}, parallel, Coherence::common_direction);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 3 / 4);
}

/// box: rays that end where they meet a sphere of a tree head-on, where its box begins.
TEST_P(BundleBounds, EndsOnTheBox) {
  CaseRandom random(76);
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 100; ++i)
      spheres.push_back({vec_cast<float>(random.direction() * random.uniform(0, 1)),
                         static_cast<float>(random.decade(-3, -1.5)), 0});
    const std::array axes = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
    const Vec3d axis = axes[static_cast<std::size_t>(random.below(3))] * random.sign();
    const Sphere& sphere = spheres[static_cast<std::size_t>(random.below(100))];
    const Vec3d center = vec_cast<double>(sphere.center);
    const Vec3d eye = center - axis * random.uniform(0, 5);
    const float scale = static_cast<float>(random.decade(-3, 3));
    std::vector<Ray> from_eye, parallel;
    for (int i = 0; i < 64; ++i) {
      const Vec3d off =
          random.perpendicular(axis) * (double{sphere.radius} * random.decade(-7, -3));
      from_eye.push_back({eye, vec_cast<float>((center + off - eye) * double{scale})});
      parallel.push_back(
          {eye + off * 1e3 - axis * random.decade(-3, 1), vec_cast<float>(axis) * scale});
    }
    for (std::vector<Ray>* rays : {&from_eye, &parallel}) {
      for (Ray& ray : *rays) {
        const Hit hit = reference::closest_hit(ray, spheres, {});
        const float t = static_cast<float>(hit.id < 0 ? 1 : hit.t);
        ray.tmax = random.chance(0.5) ? t : std::nextafter(t, random.chance(0.5) ? 2 * t : 0.0F);
      }
    }
    check(spheres, from_eye, Coherence::common_origin);
    check(spheres, parallel, Coherence::common_direction);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 9 / 10);
}

/// bundle_across: the same from one eye, where most rays are much shorter than one of them.
TEST_P(BundleBounds, RaysOfManyLengths) {
  CaseRandom random(78);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 100; ++i)
      spheres.push_back({vec_cast<float>(random.direction() * random.uniform(0, 1)),
                         static_cast<float>(random.decade(-3, -1.5)), 0});
    const Sphere& sphere = spheres[static_cast<std::size_t>(random.below(100))];
    const Vec3d axis = Vec3d{0, 0, 1} * random.sign(), center = vec_cast<double>(sphere.center);
    const Vec3d eye = center - axis * random.uniform(2, 5);
    std::vector<Ray> rays;
    for (int i = 0; i < 64; ++i) {
      const Vec3d off =
          random.perpendicular(axis) * (double{sphere.radius} * random.decade(-7, -3));
      const double scale = i == 48 ? random.decade(1, 4) : random.decade(-0.5, 0.5);
      rays.push_back({eye, vec_cast<float>((center + off - eye) * scale)});
      const Hit hit = reference::closest_hit(rays.back(), spheres, {});
      const float t = static_cast<float>(hit.id < 0 ? 1 : hit.t);
      rays.back().tmax = std::nextafter(t, random.chance(0.5) ? 2 * t : 0.0F);
    }
    check(spheres, rays, Coherence::common_origin);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 4);
  EXPECT_LT(met, all * 9 / 10);
}

/// bundle_axis: tiles that are wide next to the spheres in them, which are met close to the rim.
TEST_P(BundleBounds, WideTilesOfSpecks) {
  CaseRandom random(75);
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3d towards = random.direction(), eye = towards * -4.0;
    std::vector<Sphere> spheres;
    std::vector<Ray> from_eye, parallel;
    const double width = random.decade(-3, -0.5), r = width * random.decade(-5, -2);
    for (int i = 0; i < 64; ++i) {
      const Vec3d at = random.perpendicular(towards) * (width * random.uniform());
      from_eye.push_back({eye, vec_cast<float>(at - eye)});
      parallel.push_back({eye + at, vec_cast<float>(towards)});
      for (const Ray& ray : {from_eye.back(), parallel.back()}) {
        const Vec3d dir = vec_cast<double>(ray.dir), side = random.perpendicular(normalize(dir));
        const Vec3d center =
            ray.org + dir * (4 / length(dir)) + side * (r * near_rim(random, -6, -2));
        spheres.push_back({vec_cast<float>(center), static_cast<float>(r), 0});
      }
    }
    check(spheres, from_eye, Coherence::common_origin);
    check(spheres, parallel, Coherence::common_direction);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 8);
}

/// Columns of specks along z from 1 to 1.1. Seen from the origin they run across its rays, from 1.1
/// (a, b) to (a, b), or back. Only one end of a column is in the way of a ray; were both, the hit
/// of one ray would hide that the other's is lost.
void add_columns(CaseRandom& random, std::vector<Sphere>& spheres, std::vector<Ray>& rays) {
  const double apart = random.uniform(0.03, 0.045);
  for (int column = 0; column < 100; ++column) {
    const double a = apart * (column % 10 - 4.5), b = apart * (column / 10 - 4.5);
    const int aim_at = random.chance(0.5) ? 0 : 7;
    const bool back = random.chance(0.5);
    for (int i = 0; i < 8; ++i) {
      const double far = i / 7.0, z = 1 + 0.1 * far, across = 1.1 - 0.1 * (back ? 1 - far : far);
      const Vec3d center{a * across, b * across, z};
      spheres.push_back({vec_cast<float>(center), 1e-4F, 0});
      if (i != aim_at) continue;
      const Vec3d through = center + random.direction() * 1.2e-4;
      Ray ray{through * (3 / z), {}};
      ray.dir = vec_cast<float>(ray.org * -1.0);
      ray.tmax = 1 - 0x1p-22F;
      rays.push_back(ray);
    }
  }
}

/// Deep leaves across the rays of a light: the extent of such a box, for the grid of rays, does not
/// follow from its near or its far side alone.
TEST_P(BundleBounds, SpecksOfDeepLeaves) {
  CaseRandom random(68);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Sphere> spheres;
    std::vector<Ray> rays;
    add_columns(random, spheres, rays);
    check(spheres, rays, Coherence::common_end);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(met, all / 3);
  EXPECT_LT(met, all);
}

INSTANTIATE_TEST_SUITE_P(Tables, BundleBounds, each_isa(), isa_name);

}  // namespace
}  // namespace boule::test
