// Distances of points and decisions about them, judged in 1400 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "simd/points/point_distance.h"
#include "tests/oracle/big_float.h"
#include "tests/support/case_random.h"

namespace boule::test::point_distances {
namespace {

using BigVec = Vec3<BigFloat>;

template <class T>
BigVec big(const Vec3<T>& v) {
  return {BigFloat(double{v.x}), BigFloat(double{v.y}), BigFloat(double{v.z})};
}

BigFloat oracle(const Ball& ball, const Vec3d& point) {
  const BigVec f = big(ball.center) - big(point);
  return sqrt(dot(f, f)) - BigFloat(double{ball.radius}) - BigFloat(double{ball.more});
}

BigFloat oracle(const Plane& plane, const Vec3d& point) {
  const BigVec n = big(plane.normal);
  return dot(n, big(point) - big(plane.point)) / sqrt(dot(n, n));
}

/// The distance from the line along the axis is that of a cross product.
BigFloat oracle(const Capsule& capsule, const Vec3d& point) {
  const BigVec u = big(capsule.b) - big(capsule.a);
  const BigVec from_a = big(point) - big(capsule.a), from_b = big(point) - big(capsule.b);
  const BigFloat radius(double{capsule.radius});
  if (dot(from_a, u).sign() <= 0) return sqrt(dot(from_a, from_a)) - radius;
  if (dot(from_b, u).sign() >= 0) return sqrt(dot(from_b, from_b)) - radius;
  const BigVec area = cross(from_a, u);
  return sqrt(dot(area, area) / dot(u, u)) - radius;
}

/// How the exact distance compares with a number, and whether a double is the nearest to it.
int sign_beyond(const BigFloat& exact, double x) { return (exact - BigFloat(x)).sign(); }

bool is_nearest(const BigFloat& exact, double x) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const BigFloat half(0.5);
  const BigFloat low = (BigFloat(x) + BigFloat(std::nextafter(x, -inf))) * half;
  const BigFloat high = (BigFloat(x) + BigFloat(std::nextafter(x, inf))) * half;
  return low <= exact && exact <= high;
}

template <class Shape>
void judge(const Shape& shape, const Vec3d& point) {
  const BigFloat exact = oracle(shape, point);
  const double distance = find_distance(shape, point);
  ASSERT_TRUE(is_nearest(exact, distance)) << distance;
  const RoughDistance rough = rough_distance(shape, point);
  if (std::isfinite(rough.error)) {
    // A quarter of the bound is in use at most.
    const double part = rough.error / 4;
    ASSERT_GE(sign_beyond(exact, rough.value - part), 0) << rough.value;
    ASSERT_LE(sign_beyond(exact, rough.value + part), 0) << rough.value;
  }
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const double limit :
       {0.0, distance, std::nextafter(distance, inf), std::nextafter(distance, -inf), 1.0, -1e300})
    ASSERT_EQ(is_within(shape, point, limit), sign_beyond(exact, limit) <= 0) << limit;
  ASSERT_TRUE(is_within(shape, point, inf));
  ASSERT_FALSE(is_within(shape, point, -inf));
}

Vec3f rounded(const Vec3d& v) { return vec_cast<float>(v); }

/// A random place, far from 0 by as much, for things of size 1 or of another size.
struct Place {
  Vec3d middle;
  double size;
};
Place place_of(CaseRandom& random, int i) {
  const double decade = random.decade(0, 7);
  const Vec3d away = random.direction() * decade;
  const double size = random.decade(-12, 12);
  if (i % 3 == 0) return {{}, 1};
  return i % 3 == 1 ? Place{away, 1} : Place{{}, size};
}

/// A point whose distance from the surface is about 10^-k of the size, or 0.
double off_surface(CaseRandom& random, double size) {
  const double share = random.decade(-18, 1);
  return size * share * random.sign();
}

TEST(PointDistanceOracle, SpheresAreExact) {
  CaseRandom random(71);
  for (int i = 0; i < 4000; ++i) {
    const Place place = place_of(random, i);
    Ball ball{rounded(place.middle + random.direction() * place.size),
              static_cast<float>(random.uniform(0.1, 2) * place.size)};
    if (i % 5 == 0) ball.more = static_cast<float>(random.uniform(0.1, 2) * place.size);
    const double r = double{ball.radius} + double{ball.more};
    const Vec3d way = random.direction() * (r + off_surface(random, place.size));
    ASSERT_NO_FATAL_FAILURE(judge(ball, vec_cast<double>(ball.center) + way)) << i;
  }
}

TEST(PointDistanceOracle, CapsulesAreExact) {
  CaseRandom random(72);
  for (int i = 0; i < 4000; ++i) {
    const Place place = place_of(random, i);
    const double length = i % 7 == 0 ? 0 : random.decade(-3, 3) * place.size;
    const Vec3d axis = random.direction();
    const Capsule capsule{rounded(place.middle), rounded(place.middle + axis * length),
                          static_cast<float>(random.uniform(0.1, 2) * place.size)};
    const Vec3d a = vec_cast<double>(capsule.a), u = vec_cast<double>(capsule.b) - a;
    // Beside the tube, at its seams, and beyond its ends.
    const double s = i % 4 == 0 ? random.below(2) : random.uniform(-0.5, 1.5);
    const Vec3d aside = random.perpendicular(axis);
    const double r = double{capsule.radius} + off_surface(random, place.size);
    ASSERT_NO_FATAL_FAILURE(judge(capsule, a + u * s + aside * r)) << i;
  }
}

TEST(PointDistanceOracle, PlanesAreExact) {
  CaseRandom random(73);
  for (int i = 0; i < 4000; ++i) {
    const Place place = place_of(random, i);
    const Vec3d normal = random.direction();
    const double stretch = random.decade(-20, 18);
    const Plane plane{rounded(place.middle), rounded(normal * stretch)};
    const Vec3d along = random.perpendicular(normal) * (random.decade(-3, 5) * place.size);
    const Vec3d off = normal * off_surface(random, place.size);
    ASSERT_NO_FATAL_FAILURE(judge(plane, vec_cast<double>(plane.point) + along + off)) << i;
  }
}

/// Distances that are doubles, halfway between two, or 0: 3, 4 and 5, and their like.
TEST(PointDistanceOracle, ExactTiesAreExact) {
  const double ulp = 0x1p-52;
  for (const Vec3d& way : {Vec3d{3, 4, 0}, {4, 4, 2}, {1, 2, 2}, {0, 0, 7}, {0, 0, 0}}) {
    const double whole = std::sqrt(dot(way, way));
    for (const double off : {0.0, ulp, 2 * ulp, 3 * ulp, 0x1p-60, 0x1p-200, 1e-190, 0.5, 1e150}) {
      const Vec3d point{way.x, way.y, way.z + off};
      judge(Ball{{}, static_cast<float>(whole)}, point);
      judge(Ball{{}, 1, static_cast<float>(whole)}, point);
      judge(Capsule{{}, {0, 0, -5}, static_cast<float>(whole)}, point);
      judge(Capsule{{-3, 0, 0}, {5, 0, 0}, 4}, point);
      judge(Plane{{1, 0, 0}, {3, 4, 0}}, point);
      judge(Plane{{0, 4, 0}, {0, -1e-45F, 0}}, point);
    }
  }
}

/// From the smallest to the largest numbers, as far as the oracle has bits for them.
TEST(PointDistanceOracle, NumbersOfAnySizeAreExact) {
  const std::vector<double> sizes = {0,     5e-324, 1e-310, 1e-200, 1e-160, 1e-120,
                                     1e-45, 1e-20,  1,      1e38,   1e90,   1e150};
  int judged = 0;
  for (const double x : sizes) {
    for (const double y : sizes) {
      for (const float r : {1e-45F, 1e-30F, 1.0F, 3e38F}) {
        double least = r, most = r;
        for (const double size : {x, y}) {
          if (size == 0) continue;
          least = std::min(least, size);
          most = std::max(most, size);
        }
        if (least < most * 1e-190) continue;
        const Vec3d point{x, -y, 0};
        judge(Ball{{}, r}, point);
        judge(Ball{{r, 0, 0}, r}, point);
        judge(Capsule{{0, 0, 0}, {r, r, 0}, r}, point);
        judge(Plane{{r, 0, 0}, {1, r, 0}}, point);
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 200);
}

/// Beyond the oracle: the distance is above 0, and rounds to 0.
TEST(PointDistanceOracle, SmallestNumberIsOutside) {
  const Vec3d beside{1, 5e-324, 0};
  EXPECT_EQ(find_distance(Ball{}, beside), 0);
  EXPECT_FALSE(is_within(Ball{}, beside, 0));
  EXPECT_TRUE(is_within(Ball{}, beside, 5e-324));
  EXPECT_TRUE(is_within(Ball{}, {1, 0, 0}, 0));
  EXPECT_EQ(find_distance(Capsule{{}, {5, 0, 0}}, {2, 1, 5e-324}), 0);
  EXPECT_FALSE(is_within(Capsule{{}, {5, 0, 0}}, {2, 1, 5e-324}, 0));
  EXPECT_EQ(find_distance(Plane{}, {3, 5e-324, 0}), 5e-324);
  EXPECT_FALSE(is_within(Plane{}, {3, 5e-324, 0}, 0));
}

}  // namespace
}  // namespace boule::test::point_distances
