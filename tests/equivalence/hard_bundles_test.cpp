// Every hard case as bundles: streams made of a case's ray that share its origin or its direction,
// or end where it begins; against the scalar path, bit for bit.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "tests/support/case_random.h"
#include "tests/support/hard_case_runs.h"

namespace boule::test::hard_bundles {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

Hit closest_of(const HardCase& hard_case, const Ray& ray) {
  return reference::closest_hit(ray, hard_case.spheres, hard_case.planes);
}

/// Whatever ends the ray, and whatever it leaves.
Hit closest_of_line(const HardCase& hard_case, const Ray& ray) {
  return closest_of(hard_case, Ray{ray.org, ray.dir});
}

/// From a ray's origin to the middle of what it is aimed at.
Vec3d view_of_target(const HardCase& hard_case, std::size_t i) {
  const auto& [spheres, planes, rays] = hard_case;
  const Vec3f target =
      spheres.empty() ? planes[i % planes.size()].point : spheres[i % spheres.size()].center;
  return vec_cast<double>(target) - rays[i].org;
}

/// How large the scene is around ray i; anything where its target is nowhere.
double size_around(const HardCase& hard_case, std::size_t i) {
  const auto& spheres = hard_case.spheres;
  const double radius = spheres.empty() ? 1.0 : double{spheres[i % spheres.size()].radius};
  const double size = length(view_of_target(hard_case, i)) + std::fabs(radius);
  return size < 1e17 ? size : 10.0;
}

/// Where ray i, as a line, comes closest to the middle of its target.
double closest_approach(const HardCase& hard_case, std::size_t i) {
  const Vec3d dir = vec_cast<double>(hard_case.rays[i].dir);
  return dot(view_of_target(hard_case, i), dir) / dot(dir, dir);
}

/// Has ray i begin in the world's origin and be of unit length: seen from there the largest scenes
/// are bundles, too.
void look_from_world_origin(HardCase& hard_case, std::size_t i) {
  Ray& ray = hard_case.rays[i];
  const Vec3d to = ray.org + vec_cast<double>(ray.dir) * closest_approach(hard_case, i);
  ray = {{0, 0, 0}, vec_cast<float>(normalize(to))};
}

/// t, or a float next to it.
float beside(CaseRandom& random, double t) {
  const auto end = static_cast<float>(t);
  const int where = random.below(3);
  return where == 0 ? end : std::nextafter(end, where == 1 ? 0.0F : inf);
}

/// How many rays a stream has, and how far apart they are at most: 10^most of what there is.
struct Spread {
  int rays;
  double most;
};

/// Of the stream made of the case's ray i: most fill a part of a bundle, a few have several packets
/// in a group.
Spread spread_of(std::size_t i) {
  const int k = static_cast<int>(i / 8);
  return {k % 32 == 5 ? 600 : 48 - k % 16, -0.8 - 2 * (k % 4)};
}

/// Puts a ray that leaves a sphere onto it.
void keep_on_source(const HardCase& hard_case, Ray& ray) {
  const auto at = static_cast<std::size_t>(ray.source);
  if (ray.source == no_primitive || at >= hard_case.spheres.size()) return;
  const Sphere& sphere = hard_case.spheres[at];
  const Vec3d center = vec_cast<double>(sphere.center), n = normalize(ray.org - center);
  ray.org = center + n * double{sphere.radius};
  ray.inside = dot(n, vec_cast<double>(ray.dir)) < 0;
}

std::vector<Ray> from_its_origin(CaseRandom& random, const HardCase& hard_case, std::size_t i) {
  const Ray& ray = hard_case.rays[i];
  const Spread spread = spread_of(i);
  const Vec3d dir = vec_cast<double>(ray.dir);
  std::vector<Ray> rays = {ray};
  while (rays.size() < static_cast<std::size_t>(spread.rays)) {
    const double off = random.decade(-8, spread.most) * length(dir);
    rays.push_back(ray);
    rays.back().dir = vec_cast<float>(dir + random.direction() * off);
  }
  return rays;
}

std::vector<Ray> in_its_direction(CaseRandom& random, const HardCase& hard_case, std::size_t i) {
  const Ray& ray = hard_case.rays[i];
  const Spread spread = spread_of(i);
  const double size = size_around(hard_case, i);
  std::vector<Ray> rays = {ray};
  while (rays.size() < static_cast<std::size_t>(spread.rays)) {
    const double off = random.decade(-12, spread.most) * size;
    rays.push_back(ray);
    rays.back().org = ray.org + random.direction() * off;
    keep_on_source(hard_case, rays.back());
  }
  return rays;
}

/// Bundles live from t = 0. They end where the case's ray does, at what they meet, or nowhere.
void bound(CaseRandom& random, const HardCase& hard_case, std::vector<Ray>& rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Ray& ray = rays[i];
    ray.tmin = i % 2 == 0 ? 0.0F : -0.0F;
    const int end = random.below(4);
    if (end == 1) ray.tmax = std::numeric_limits<float>::max();
    if (end == 2) ray.tmax = inf;
    if (end == 3) ray.tmax = beside(random, closest_of_line(hard_case, ray).t);
  }
}

/// A shadow ray from `point`, which lies on the primitive `id`.
Ray leave(const HardCase& hard_case, const Vec3d& point, std::int32_t id, const Vec3d& light) {
  Ray ray = segment(point, light);
  ray.source = id;
  const auto at = static_cast<std::size_t>(id);
  if (at < hard_case.spheres.size()) {
    const Vec3d center = vec_cast<double>(hard_case.spheres[at].center);
    ray.inside = dot(point - center, vec_cast<double>(ray.dir)) < 0;
  }
  return ray;
}

/// A shadow ray to the origin of `ray`, from where that hits something, next to there, or beyond;
/// from about t = `otherwise` if it does not.
Ray back_to_origin(CaseRandom& random, const HardCase& hard_case, const Ray& ray,
                   double otherwise) {
  const Hit hit = closest_of_line(hard_case, ray);
  const bool met = hit.id != no_primitive;
  const int where = random.below(3);
  double t = met ? hit.t : otherwise;
  if (where == 1) {
    const double sign = random.sign();
    t *= 1 + sign * random.decade(-15, -1);
  }
  if (where == 2) t *= random.decade(0, 5);
  const Vec3d point = ray.org + vec_cast<double>(ray.dir) * t;
  return met && where == 0 ? leave(hard_case, point, hit.id, ray.org) : segment(point, ray.org);
}

std::vector<Ray> to_its_origin(CaseRandom& random, const HardCase& hard_case, std::size_t i) {
  const double otherwise = closest_approach(hard_case, i);
  std::vector<Ray> rays;
  for (const Ray& ray : from_its_origin(random, hard_case, i)) {
    rays.push_back(back_to_origin(random, hard_case, ray, otherwise));
    double& tmax = rays.back().tmax;
    const int end = random.below(8);
    if (end == 0) tmax = static_cast<float>(random.uniform());
    if (end == 1) tmax = std::fmin(beside(random, closest_of_line(hard_case, rays.back()).t), 1.0F);
  }
  return rays;
}

/// Adds a shadow ray that passes the target of the case's ray i, a sphere, as near to its rim as
/// that does, as seen from the light; none where that makes no sense.
void add_past_target(CaseRandom& random, const HardCase& hard_case, std::size_t i,
                     const Vec3d& light, std::vector<Ray>& rays) {
  const Vec3d passes = view_of_target(hard_case, i) -
                       vec_cast<double>(hard_case.rays[i].dir) * closest_approach(hard_case, i);
  const Sphere& sphere = hard_case.spheres[i % hard_case.spheres.size()];
  const Vec3d view = vec_cast<double>(sphere.center) - light;
  const double distance = length(view), impact = length(passes) / distance;
  if (!(distance > 0 && std::isfinite(distance) && impact <= 1)) return;
  const Vec3d towards = view * (1 / distance), side = random.perpendicular(towards);
  const Vec3d dir = towards * std::sqrt(1 - impact * impact) + side * impact;
  const double from = distance * random.decade(-0.3, 3);
  rays.push_back(segment(light + dir * from, light));
}

/// In any order.
void shuffle(CaseRandom& random, std::vector<Ray>& rays) {
  for (std::size_t left = rays.size(); left > 1; --left) {
    const int at = random.below(static_cast<int>(left));
    std::swap(rays[static_cast<std::size_t>(at)], rays[left - 1]);
  }
}

/// From all that the case's rays hit, and from around it, to one light.
std::vector<Ray> to_light(CaseRandom& random, const HardCase& hard_case, const Vec3d& light) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < hard_case.rays.size(); ++i) {
    const Ray& ray = hard_case.rays[i];
    const Hit hit = closest_of_line(hard_case, ray);
    if (hit.id != no_primitive) {
      const Vec3d point = ray.org + vec_cast<double>(ray.dir) * hit.t;
      rays.push_back(leave(hard_case, point, hit.id, light));
      const double beyond = 1 + random.decade(-12, 1);
      rays.push_back(segment(light + (point - light) * beyond, light));
    }
    if (hard_case.spheres.empty()) continue;
    for (int k = 0; k < 2; ++k) add_past_target(random, hard_case, i, light, rays);
  }
  shuffle(random, rays);
  return rays;
}

/// No NaN among them: it would keep the others out of their bundle.
std::vector<Ray> finite_ones(const std::vector<Ray>& rays) {
  std::vector<Ray> result;
  for (const Ray& ray : rays) {
    if (is_finite(ray.org) && is_finite(ray.dir)) result.push_back(ray);
  }
  return result;
}

class HardBundles : public OnEachHardCase {
 protected:
  /// Takes the case with so many primitives. Alone, no other hides what becomes of its rim.
  void use(std::size_t primitives) {
    hard_case = make_hard_case(GetParam().spec, primitives, 517);
    for (std::size_t i = 8; i < hard_case.rays.size(); i += 64)
      look_from_world_origin(hard_case, i);
    geometries.clear();
    for (const Structure structure : {Structure::scan, Structure::bvh})
      geometries.emplace_back(hard_case.spheres, hard_case.planes, structure);
  }

  void check_closest(const std::vector<Ray>& rays, Coherence coherence) {
    std::vector<Hit> expected;
    for (const Ray& ray : rays) expected.push_back(closest_of(hard_case, ray));
    for (const Geometry& geometry : geometries) {
      const auto hits = run_closest(*kernels, geometry.view(), rays, query(coherence));
      for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_TRUE(same_bits(hits[i], expected[i]))
            << "ray " << i << " structure " << (&geometry - geometries.data()) << ": id "
            << hits[i].id << " t " << hits[i].t << ", expected " << expected[i].id << " "
            << expected[i].t;
      }
    }
  }

  /// In streams of at most so many rays.
  void check_any(const std::vector<Ray>& rays, Coherence coherence, std::size_t most) {
    std::vector<int> expected;
    for (const Ray& ray : rays)
      expected.push_back(reference::any_hit(ray, hard_case.spheres, hard_case.planes) ? 1 : 0);
    for (const int hit : expected) met += hit;
    for (const Geometry& geometry : geometries) {
      for (std::size_t begin = 0; begin < rays.size(); begin += most) {
        const auto from = rays.begin() + static_cast<std::ptrdiff_t>(begin);
        const std::vector<Ray> stream(from,
                                      from + std::min<std::ptrdiff_t>(most, rays.end() - from));
        const auto occluded = run_any(*kernels, geometry.view(), stream, query(coherence));
        for (std::size_t i = 0; i < stream.size(); ++i)
          ASSERT_EQ(occluded[i], expected[begin + i])
              << "ray " << begin + i << " structure " << (&geometry - geometries.data());
      }
    }
  }

  static Query query(Coherence coherence) { return {Solver::robust, Form::automatic, coherence}; }

  HardCase hard_case;
  std::vector<Geometry> geometries;  ///< scan, bvh
  int met = 0;
};

TEST_P(HardBundles, GiveTheScalarPathsAnswers) {
  CaseRandom random(81);
  for (const std::size_t primitives : {1, 61}) {
    use(primitives);
    for (std::size_t i = 0; i < hard_case.rays.size(); i += 8) {
      for (const Coherence coherence : {Coherence::common_origin, Coherence::common_direction}) {
        SCOPED_TRACE(testing::Message() << primitives << " primitives, of ray " << i << " common "
                                        << static_cast<int>(coherence));
        auto rays = coherence == Coherence::common_origin ? from_its_origin(random, hard_case, i)
                                                          : in_its_direction(random, hard_case, i);
        bound(random, hard_case, rays);
        check_any(rays, coherence, rays.size());
        // Rays of a bundle whose nearest hit is sought leave nothing.
        for (Ray& ray : rays) ray.source = no_primitive;
        check_closest(rays, coherence);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(met, 0);
}

TEST_P(HardBundles, FindShadows) {
  CaseRandom random(82);
  for (const std::size_t primitives : {1, 61}) {
    use(primitives);
    for (std::size_t i = 0; i < hard_case.rays.size(); i += 8) {
      SCOPED_TRACE(testing::Message() << primitives << " primitives, to ray " << i);
      const auto rays = to_its_origin(random, hard_case, i);
      check_any(rays, Coherence::common_end, rays.size());
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(met, 0);
}

/// All together, in no order: many are sorted first, and few as well where many spheres are in
/// their way, as there are from far away.
TEST_P(HardBundles, SortShadowRays) {
  CaseRandom random(83);
  for (const std::size_t primitives : {1, 61}) {
    use(primitives);
    const Vec3d eye = hard_case.rays[0].org, far = eye - view_of_target(hard_case, 0) * 15.0;
    for (const Vec3d& light : {Vec3d{0, 0, 0}, eye, far}) {
      SCOPED_TRACE(testing::Message() << primitives << " primitives, light " << light.x);
      const auto rays = to_light(random, hard_case, light);
      const auto finite = finite_ones(rays);
      check_any(finite, Coherence::common_end, finite.size());
      check_any(finite, Coherence::common_end, 64);
      if (finite.size() != rays.size()) check_any(rays, Coherence::common_end, rays.size());
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(met, 0);
}

INSTANTIATE_TEST_SUITE_P(Tables, HardBundles, each_hard_case(), hard_case_name);

}  // namespace
}  // namespace boule::test::hard_bundles
