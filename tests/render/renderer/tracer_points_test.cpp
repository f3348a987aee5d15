// What is near points, judged by long double over all primitives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/scene/instances.h"
#include "render/renderer/tracer.h"
#include "tests/support/case_random.h"

namespace boule::test::tracer_points {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

/// How many primitives and points: more by hand, BOULE_POINTS=10000.
int case_size() {
  const char* const given = std::getenv("BOULE_POINTS");
  return given == nullptr ? 400 : std::atoi(given);
}

struct PointCase {
  std::string name;
  Scene scene;
  std::vector<Vec3d> points;
};

Vec3d point_in(CaseRandom& random, double size) {
  const double x = random.uniform(-size, size);
  const double y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

Scene empty_scene() {
  Scene scene;
  scene.materials = {{"", Matte{}}};
  return scene;
}

/// Points in and around the primitives: everywhere, on their surfaces as far as doubles can be, at
/// their centres, and far away.
std::vector<Vec3d> points_around(const Scene& scene, const Vec3d& middle, double size) {
  CaseRandom random(82);
  std::vector<Vec3d> points;
  for (int i = 0; i < case_size(); ++i) {
    const Vec3d from = middle + point_in(random, 1.5 * size);
    const auto pick = static_cast<std::size_t>(random.below(1 << 20));
    const Vec3d way = random.direction();
    points.push_back(from);
    if (scene.spheres.empty() || i % 4 == 0) continue;
    const Sphere& sphere = scene.spheres[pick % scene.spheres.size()];
    const Vec3d center = vec_cast<double>(sphere.center);
    if (i % 4 == 1) points.back() = center;
    if (i % 4 == 2) points.back() = center + way * double{sphere.radius};
    if (i % 32 == 3) points.back() = middle + way * (size * 1e9);
  }
  return points;
}

std::vector<PointCase> make_cases() {
  CaseRandom random(81);
  const int count = case_size();
  const double spacing = 2 / std::cbrt(count);
  std::vector<PointCase> cases;
  const auto add = [&](const std::string& name, const Vec3d& middle, double size,
                       const auto& make) {
    Scene scene = empty_scene();
    for (int i = 0; i < count; ++i) make(scene, i);
    cases.push_back({name, scene, points_around(scene, middle, size)});
  };
  const auto sphere = [](const Vec3d& center, double r) {
    return Sphere{vec_cast<float>(center), static_cast<float>(r)};
  };
  add("overlapping", {}, 1, [&](Scene& scene, int) {
    const Vec3d center = point_in(random, 1);
    scene.spheres.push_back(sphere(center, random.uniform(0.2, 2) * spacing));
  });
  add("nested", {}, 1, [&](Scene& scene, int) {
    const Vec3d center = point_in(random, 0.05);
    scene.spheres.push_back(sphere(center, random.decade(-2, 0)));
  });
  add("coincident", {}, 1, [&](Scene& scene, int i) {
    scene.spheres.push_back({{static_cast<float>(i % 20) / 20, 0, 0}, 0.25F});
  });
  add("tangent", {8, 8, 8}, 8, [&](Scene& scene, int i) {
    const int row = 16;
    const Vec3d center{double(i % row), double(i / row % row), double(i / row / row)};
    scene.spheres.push_back(sphere(center, 0.5));
  });
  const Vec3d away{1e6, -2e6, 3e6};
  add("far", away, 100, [&](Scene& scene, int) {
    const Vec3d center = away + point_in(random, 100);
    scene.spheres.push_back(sphere(center, random.uniform(0.2, 200) * spacing));
  });
  add("of all sizes", {}, 1, [&](Scene& scene, int i) {
    const Vec3d center = point_in(random, 1);
    scene.spheres.push_back(sphere(center, random.decade(-6, i % 50 == 0 ? 3 : -1)));
  });
  add("all kinds", {}, 1, [&](Scene& scene, int i) {
    const Vec3d a = point_in(random, 1), way = random.direction();
    const double r = random.uniform(0.1, 1) * spacing, length = random.decade(-2, 0);
    if (i % 2 == 0) scene.spheres.push_back(sphere(a, r));
    if (i % 100 == 1) scene.planes.push_back({vec_cast<float>(a * 2.0), vec_cast<float>(way)});
    const Vec3f end = vec_cast<float>(a + way * length);
    if (i % 2 == 1) scene.capsules.push_back({vec_cast<float>(a), end, static_cast<float>(r)});
  });
  return cases;
}

const std::vector<PointCase>& point_cases() {
  static const std::vector<PointCase> cases = make_cases();
  return cases;
}

using LongVec = Vec3<long double>;

long double length(const LongVec& v) { return std::sqrt(dot(v, v)); }

/// A distance in long double, and how wrong it may be. The formulas are others than the engine's:
/// the nearest of both ends and the foot of the perpendicular.
struct LongDistance {
  long double value, doubt;
};

LongDistance long_distance(const Sphere& sphere, const Vec3d& point) {
  const LongVec way = vec_cast<long double>(point) - vec_cast<long double>(sphere.center);
  const auto r = static_cast<long double>(sphere.radius);
  return {length(way) - r, 1e-18L * (length(way) + r)};
}
LongDistance long_distance(const Plane& plane, const Vec3d& point) {
  const LongVec way = vec_cast<long double>(point) - vec_cast<long double>(plane.point);
  const LongVec n = vec_cast<long double>(plane.normal);
  return {dot(way, n) / length(n), 1e-18L * length(way)};
}
LongDistance long_distance(const Capsule& capsule, const Vec3d& point) {
  const LongVec a = vec_cast<long double>(capsule.a), b = vec_cast<long double>(capsule.b);
  const LongVec p = vec_cast<long double>(point), u = b - a;
  long double least = std::min(length(p - a), length(p - b));
  const bool is_beside = dot(p - a, u) > 0 && dot(p - b, u) < 0;
  if (is_beside) least = std::min(least, length(cross(p - a, u)) / length(u));
  const auto r = static_cast<long double>(capsule.radius);
  return {least - r, 1e-17L * (length(p - a) + length(u) + r)};
}

std::vector<LongDistance> long_distances(const Scene& scene, const Vec3d& point) {
  std::vector<LongDistance> all;
  for (const Sphere& sphere : scene.spheres) all.push_back(long_distance(sphere, point));
  for (const Plane& plane : scene.planes) all.push_back(long_distance(plane, point));
  for (const Capsule& capsule : scene.capsules) all.push_back(long_distance(capsule, point));
  return all;
}

struct NearestLists {
  std::vector<double> distance;
  std::vector<std::int32_t> id;

  bool operator==(const NearestLists&) const = default;
};
NearestLists nearest(Tracer& tracer, const std::vector<Vec3d>& points, std::size_t k,
                     double limit = inf) {
  NearestLists found{std::vector<double>(points.size() * k),
                     std::vector<std::int32_t>(points.size() * k)};
  EXPECT_TRUE(tracer.nearest(points, k, limit, {found.distance.data(), found.id.data()}));
  return found;
}

std::vector<std::int32_t> list_of(const Members& members, std::size_t k) {
  return {members.id.begin() + static_cast<std::ptrdiff_t>(members.offset[k]),
          members.id.begin() + static_cast<std::ptrdiff_t>(members.offset[k + 1])};
}

Tracer make_tracer(const Scene& scene, const TraceOptions& options = {}) {
  return Tracer::create(scene, options).value();
}

double as_double(long double x) { return static_cast<double>(x); }

/// Every distance is that of its primitive, they come in order, and nothing nearer is left out.
TEST(TracerPoints, NearestAreThoseOfLongDouble) {
  for (const PointCase& one : point_cases()) {
    Tracer tracer = make_tracer(one.scene);
    constexpr std::size_t k = 8;
    const NearestLists found = nearest(tracer, one.points, k);
    const NearestLists first = nearest(tracer, one.points, 1);
    for (std::size_t row = 0; row < one.points.size(); ++row) {
      const auto all = long_distances(one.scene, one.points[row]);
      std::vector<bool> is_found(all.size());
      for (std::size_t i = 0; i < k; ++i) {
        const std::size_t at = row * k + i;
        const double distance = found.distance[at];
        const auto id = static_cast<std::size_t>(found.id[at]);
        ASSERT_LT(id, all.size()) << one.name;
        ASSERT_FALSE(is_found[id]) << one.name;
        is_found[id] = true;
        const double half_ulp = std::fabs(distance) * 0x1p-53;
        ASSERT_LE(as_double(std::fabs(all[id].value - distance)),
                  half_ulp + as_double(all[id].doubt))
            << one.name << " point " << row;
        if (i == 0) continue;
        ASSERT_LT(std::pair(found.distance[at - 1], found.id[at - 1]),
                  std::pair(distance, found.id[at]))
            << one.name << " point " << row;
      }
      const double last = found.distance[row * k + k - 1];
      for (std::size_t id = 0; id < all.size(); ++id) {
        if (!is_found[id])
          ASSERT_GE(as_double(all[id].value + all[id].doubt) + std::fabs(last) * 0x1p-53, last);
      }
      ASSERT_EQ(first.id[row], found.id[row * k]);
      ASSERT_EQ(first.distance[row], found.distance[row * k]);
    }
  }
}

TEST(TracerPoints, MembersAreThoseOfLongDouble) {
  for (const PointCase& one : point_cases()) {
    Tracer tracer = make_tracer(one.scene);
    for (const double radius : {0.0, 0.1, -0.05}) {
      const Members found = radius == 0 ? tracer.inside(one.points).value()
                                        : tracer.within(one.points, radius).value();
      std::vector<std::int32_t> ids(one.points.size());
      ASSERT_TRUE(tracer.first_inside(one.points, ids));
      std::size_t certain = 0;
      for (std::size_t row = 0; row < one.points.size(); ++row) {
        const std::vector<std::int32_t> list = list_of(found, row);
        ASSERT_TRUE(std::is_sorted(list.begin(), list.end())) << one.name;
        if (radius == 0) ASSERT_EQ(ids[row], list.empty() ? no_primitive : list[0]);
        const auto all = long_distances(one.scene, one.points[row]);
        for (std::size_t id = 0; id < all.size(); ++id) {
          const long double beyond = all[id].value - static_cast<long double>(radius);
          if (std::fabs(beyond) <= all[id].doubt) continue;
          const bool is_member =
              std::binary_search(list.begin(), list.end(), static_cast<std::int32_t>(id));
          ASSERT_EQ(is_member, beyond < 0) << one.name << " point " << row << " id " << id;
          certain += is_member ? 1 : 0;
        }
      }
      EXPECT_GT(certain + (radius < 0 ? 1 : 0), 0U) << one.name;
    }
  }
}

TEST(TracerPoints, PairsAreThoseOfLongDouble) {
  for (const PointCase& one : point_cases()) {
    Tracer tracer = make_tracer(one.scene);
    for (const double gap : {0.0, 0.01, -0.02}) {
      const SpherePairs found = tracer.pairs(gap).value();
      std::size_t at = 0;
      const auto count = static_cast<std::int32_t>(one.scene.spheres.size());
      for (std::int32_t i = 0; i < count; ++i) {
        const Sphere& sphere = one.scene.spheres[static_cast<std::size_t>(i)];
        const auto r = static_cast<long double>(sphere.radius);
        for (std::int32_t j = i + 1; j < count; ++j) {
          const LongDistance other = long_distance(one.scene.spheres[static_cast<std::size_t>(j)],
                                                   vec_cast<double>(sphere.center));
          const long double exact = other.value - r, doubt = other.doubt + 1e-18L * r;
          const bool is_there =
              at < found.gap.size() && found.first[at] == i && found.second[at] == j;
          if (std::fabs(exact - static_cast<long double>(gap)) > doubt)
            ASSERT_EQ(is_there, exact < static_cast<long double>(gap)) << one.name << i << " " << j;
          if (!is_there) continue;
          ASSERT_LE(as_double(std::fabs(exact - static_cast<long double>(found.gap[at]))),
                    std::fabs(found.gap[at]) * 0x1p-53 + as_double(doubt));
          ++at;
        }
      }
      ASSERT_EQ(at, found.gap.size()) << one.name;
    }
  }
}

/// A lattice: every number is exact, and every neighbour touches.
TEST(TracerPoints, TouchingSpheresArePairs) {
  Scene scene = empty_scene();
  for (int i = 0; i < 1000; ++i)
    scene.spheres.push_back({{float(i % 10), float(i / 10 % 10), float(i / 100)}, 0.5F});
  Tracer tracer = make_tracer(scene);
  const SpherePairs touching = tracer.pairs().value();
  EXPECT_EQ(touching.gap.size(), 3U * 900U);
  EXPECT_TRUE(
      std::all_of(touching.gap.begin(), touching.gap.end(), [](double x) { return x == 0; }));
  EXPECT_TRUE(tracer.pairs(-0x1p-1074).value().gap.empty());
  EXPECT_TRUE(tracer.pairs(-inf).value().gap.empty());
  EXPECT_EQ(tracer.pairs(inf).value().gap.size(), 1000U * 999U / 2);
  // Six points touch six neighbours of a sphere, and belong to two.
  const Members both = tracer.inside({{{0.5, 0, 0}, {0.5, 0.5, 0}, {4, 4.5, 4}}}).value();
  EXPECT_EQ(both.offset, (std::vector<std::int64_t>{0, 2, 2, 4}));
}

TEST(TracerPoints, AnswersAreTheSameEverywhere) {
  for (const PointCase& one : point_cases()) {
    Tracer tracer = make_tracer(one.scene, {.threads = 1});
    const NearestLists found = nearest(tracer, one.points, 5);
    const Members members = tracer.within(one.points, 0.1).value();
    const SpherePairs pairs = tracer.pairs(0.01).value();
    for (const unsigned threads : {2U, 5U}) {
      Tracer other = make_tracer(one.scene, {.solver = Solver::fast, .threads = threads});
      EXPECT_EQ(nearest(other, one.points, 5), found) << one.name;
      EXPECT_EQ(other.within(one.points, 0.1).value().id, members.id);
      EXPECT_EQ(other.pairs(0.01).value().gap, pairs.gap);
    }
    // Many points, so that they are put in order; each is there forty times.
    std::vector<Vec3d> many;
    for (int i = 0; i < 40; ++i) many.insert(many.end(), one.points.rbegin(), one.points.rend());
    const NearestLists all = nearest(tracer, many, 1);
    const std::size_t count = one.points.size();
    for (std::size_t row = 0; row < many.size(); ++row) {
      ASSERT_EQ(all.id[row], found.id[(count - 1 - row % count) * 5]);
      ASSERT_EQ(all.distance[row], found.distance[(count - 1 - row % count) * 5]);
    }
  }
}

TEST(TracerPoints, LimitsCountTheirEnd) {
  const PointCase& one = point_cases()[0];
  Tracer tracer = make_tracer(one.scene);
  const NearestLists all = nearest(tracer, one.points, 6);
  const double limit = all.distance[3];
  const NearestLists some = nearest(tracer, one.points, 6, limit);
  EXPECT_LE(std::fabs(limit), 1);
  std::size_t left = 0;
  for (std::size_t i = 0; i < all.id.size(); ++i) {
    if (all.distance[i] == limit) continue;
    const bool counts = all.distance[i] < limit;
    ASSERT_EQ(some.id[i], counts ? all.id[i] : no_primitive);
    ASSERT_EQ(some.distance[i], counts ? all.distance[i] : inf);
    left += counts ? 0 : 1;
  }
  EXPECT_GT(left, 0U);
}

/// Shared groups are answered as the same spheres written out.
TEST(TracerPoints, SharedGroupsAnswerAsWrittenOut) {
  Scene shared = empty_scene();
  CaseRandom random(83);
  Group group;
  group.name = "part";
  for (int i = 0; i < 1000; ++i) {
    const Vec3d center = point_in(random, 1);
    group.spheres.push_back(
        {vec_cast<float>(center), static_cast<float>(random.uniform(0.02, 0.06))});
  }
  shared.groups.push_back(group);
  for (int i = 0; i < 200; ++i) {
    Instance instance;
    instance.group = 0;
    instance.translate = vec_cast<float>(point_in(random, 5));
    instance.rotate = vec_cast<float>(point_in(random, 180));
    instance.scale = static_cast<float>(random.uniform(0.2, 2));
    shared.instances.push_back(instance);
  }
  Scene written = shared;
  expand_instances(written);
  ASSERT_EQ(written.spheres.size(), 200U * 1000U);
  ASSERT_TRUE(groups_to_share(shared));
  std::vector<Vec3d> points;
  for (int i = 0; i < 500; ++i) points.push_back(point_in(random, 7));
  Tracer a = make_tracer(shared), b = make_tracer(written);
  EXPECT_EQ(nearest(a, points, 7), nearest(b, points, 7));
  EXPECT_EQ(a.within(points, 0.3).value().id, b.within(points, 0.3).value().id);
  const SpherePairs pairs_a = a.pairs(-0.05).value(), pairs_b = b.pairs(-0.05).value();
  EXPECT_GT(pairs_a.gap.size(), 100U);
  EXPECT_EQ(pairs_a.first, pairs_b.first);
  EXPECT_EQ(pairs_a.second, pairs_b.second);
  EXPECT_EQ(pairs_a.gap, pairs_b.gap);
}

TEST(TracerPoints, BadPointsAreRefused) {
  Tracer tracer = make_tracer(point_cases()[0].scene);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> distance(3);
  std::vector<std::int32_t> id(3);
  for (const double bad : {nan, inf, -inf, 1.1e150}) {
    const std::vector<Vec3d> points = {{}, {}, {0, bad, 0}};
    const Status done = tracer.nearest(points, 1, inf, {distance.data(), id.data()});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().key, "points");
    EXPECT_NE(done.error().message.find("row 2: "), std::string::npos);
    EXPECT_FALSE(tracer.inside(points));
    EXPECT_FALSE(tracer.first_inside(points, id));
  }
  const std::vector<Vec3d> good(3);
  EXPECT_EQ(tracer.within(good, nan).error().key, "radius");
  EXPECT_EQ(tracer.pairs(nan).error().key, "gap");
  EXPECT_EQ(tracer.nearest(good, 1, nan, {distance.data(), id.data()}).error().key, "limit");
  EXPECT_EQ(tracer.nearest(good, 0, inf, {distance.data(), id.data()}).error().key, "k");
  Tracer moved = std::move(tracer);
  EXPECT_FALSE(tracer.inside(good));
  EXPECT_FALSE(tracer.pairs());
  EXPECT_TRUE(moved.inside(good));
  EXPECT_EQ(moved.statistics().points, good.size());
}

}  // namespace
}  // namespace boule::test::tracer_points
