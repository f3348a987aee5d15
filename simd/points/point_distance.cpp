#include "simd/points/point_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "simd/points/error_free.h"
#include "simd/points/exact_number.h"

namespace boule {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A computed distance, and a number that its error is a small fraction of: docs/numerics.md.
template <class Number>
struct Measured {
  Number distance;
  double scale;
};

template <class Number>
Vec3<Number> numbers_of(const Vec3f& v) {
  return {double{v.x}, double{v.y}, double{v.z}};
}

/// From a point of a primitive to a point.
template <class Number>
Vec3<Number> way(const Vec3f& from, const Vec3d& to) {
  return Vec3<Number>{to.x, to.y, to.z} - numbers_of<Number>(from);
}
template <>
Vec3<Double2> way(const Vec3f& from, const Vec3d& to) {
  return {two_sum(to.x, -double{from.x}), two_sum(to.y, -double{from.y}),
          two_sum(to.z, -double{from.z})};
}

double head(double x) { return x; }
double head(const Double2& x) { return x.hi; }

template <class Number>
double size_of(const Vec3<Number>& v) {
  return std::fabs(head(v.x)) + std::fabs(head(v.y)) + std::fabs(head(v.z));
}

/// The square of a length: with fewer operations than Double2 needs for any sum of products, for
/// squares are above 0. What is left out is below 2^-103 of it.
double squared(const Vec3<double>& v) { return dot(v, v); }
Double2 squared(const Vec3<Double2>& v) {
  const Double2 x = two_product(v.x.hi, v.x.hi), y = two_product(v.y.hi, v.y.hi);
  const Double2 z = two_product(v.z.hi, v.z.hi), xy = two_sum(x.hi, y.hi),
                sum = two_sum(xy.hi, z.hi);
  const double twice = v.x.hi * v.x.lo + v.y.hi * v.y.lo + v.z.hi * v.z.lo;
  return fast_two_sum(sum.hi, sum.lo + xy.lo + (x.lo + y.lo + z.lo) + 2 * twice);
}

template <class Number>
Measured<Number> measure(const Ball& ball, const Vec3d& point) {
  const Vec3<Number> f = way<Number>(ball.center, point);
  const Number radius = Number(double{ball.radius}) + Number(double{ball.more});
  return {root(squared(f)) - radius, size_of(f) + std::fabs(head(radius))};
}

template <class Number>
Measured<Number> measure(const Plane& plane, const Vec3d& point) {
  const Vec3<Number> f = way<Number>(plane.point, point), n = numbers_of<Number>(plane.normal);
  return {dot(n, f) / root(dot(n, n)), size_of(f)};
}

/// The nearest point of the segment is at s u from its beginning. An error of s counts by its
/// square, so that it may be that of a double.
template <class Number>
Measured<Number> measure(const Capsule& capsule, const Vec3d& point) {
  const Vec3<Number> f = way<Number>(capsule.a, point);
  const Vec3<Number> u = numbers_of<Number>(capsule.b) - numbers_of<Number>(capsule.a);
  const Number along = dot(f, u), whole = dot(u, u);
  Number s = 0.0;
  if (head(along) > 0) s = head(along) < head(whole) ? along / whole : Number(1.0);
  const Vec3<Number> rest = f - u * s;
  const double radius = capsule.radius;
  return {root(dot(rest, rest)) - Number(radius), size_of(f) + size_of(u) + std::fabs(radius)};
}

/// The sign of distance - limit, by sums and products alone.
template <class Number>
int sign_beyond(const Ball& ball, const Vec3d& point, const Number& limit) {
  const Number reach = Number(double{ball.radius}) + Number(double{ball.more}) + limit;
  if (reach.sign() < 0) return 1;
  const Vec3<Number> f = way<Number>(ball.center, point);
  return (dot(f, f) - reach * reach).sign();
}

template <class Number>
int sign_beyond(const Plane& plane, const Vec3d& point, const Number& limit) {
  const Vec3<Number> f = way<Number>(plane.point, point), n = numbers_of<Number>(plane.normal);
  const Number height = dot(n, f);
  const int side = height.sign(), wanted = limit.sign();
  if (side == unknown_sign || wanted == unknown_sign) return unknown_sign;
  if (side != wanted) return side > wanted ? 1 : -1;
  const int larger = (height * height - limit * limit * dot(n, n)).sign();
  return larger == unknown_sign ? larger : larger * side;
}

template <class Number>
int sign_beyond(const Capsule& capsule, const Vec3d& point, const Number& limit) {
  const Vec3<Number> f = way<Number>(capsule.a, point);
  const Vec3<Number> u = numbers_of<Number>(capsule.b) - numbers_of<Number>(capsule.a);
  const Number along = dot(f, u), whole = dot(u, u);
  const int after_a = along.sign(), after_b = (along - whole).sign();
  if (after_a == unknown_sign || after_b == unknown_sign) return unknown_sign;
  if (after_a <= 0) return sign_beyond(Ball{capsule.a, capsule.radius}, point, limit);
  if (after_b >= 0) return sign_beyond(Ball{capsule.b, capsule.radius}, point, limit);
  const Number reach = Number(double{capsule.radius}) + limit;
  if (reach.sign() < 0) return 1;
  return (dot(f, f) * whole - along * along - reach * reach * whole).sign();
}

/// The errors of measure(), as parts of its scale: docs/numerics.md.
constexpr double rough_error = 0x1p-47, fine_error = 0x1p-92;
/// Below this scale products may underflow.
constexpr double least_scale = 0x1p-400;

/// The sign of distance - limit. Precondition: both are finite.
template <class Shape>
int exact_sign(const Shape& shape, const Vec3d& point, double limit) {
  const int sign = sign_beyond<UnroundedDouble>(shape, point, limit);
  return sign != unknown_sign ? sign : sign_beyond<ExactNumber>(shape, point, limit);
}

/// Doubles in order as whole numbers, and the reverse.
std::int64_t place_of(double x) {
  const auto bits = std::bit_cast<std::int64_t>(std::fabs(x));
  return x < 0 ? -bits : bits;
}
double at_place(std::int64_t place) {
  const auto x = std::bit_cast<double>(place < 0 ? -place : place);
  return place < 0 ? -x : x;
}

/// The double next to the exact distance: the search starts at `near`, which has its sign or not.
template <class Shape>
double round_exactly(const Shape& shape, const Vec3d& point, double near) {
  const int side = exact_sign(shape, point, 0);
  if (side == 0) return 0;
  constexpr double largest = std::numeric_limits<double>::max();
  const std::int64_t low = side > 0 ? 0 : place_of(-largest),
                     high = side > 0 ? place_of(largest) : 0;
  // The distance is between `from` and `to`, which are brought together.
  std::int64_t from = std::clamp(place_of(near), low, high), to = from;
  const int sign = exact_sign(shape, point, at_place(from));
  if (sign == 0) return at_place(from);
  for (std::int64_t step = 1;; step *= 2) {
    to = sign > 0 ? from + std::min(step, high - from) : from - std::min(step, from - low);
    const int there = exact_sign(shape, point, at_place(to));
    if (there == 0) return at_place(to);
    if (there != sign) break;
    from = to;
  }
  while (to - from != sign) {
    const std::int64_t middle = from + (to - from) / 2;
    const int there = exact_sign(shape, point, at_place(middle));
    if (there == 0) return at_place(middle);
    (there == sign ? from : to) = middle;
  }
  const ExactNumber middle = (ExactNumber(at_place(from)) + at_place(to)) * 0.5;
  const int rest = sign_beyond(shape, point, middle) * sign;
  if (rest == 0) return at_place(from % 2 == 0 ? from : to);
  return at_place(rest > 0 ? to : from);
}

template <class Shape>
RoughDistance rough(const Shape& shape, const Vec3d& point) {
  const auto [distance, scale] = measure<double>(shape, point);
  return {distance, scale >= least_scale ? scale * rough_error : infinity};
}

template <class Shape>
double rounded(const Shape& shape, const Vec3d& point) {
  const auto [distance, scale] = measure<Double2>(shape, point);
  const double error = scale * fine_error;
  const bool is_sure = scale >= least_scale && distance.hi + (distance.lo + error) == distance.hi &&
                       distance.hi + (distance.lo - error) == distance.hi;
  return is_sure ? distance.hi : round_exactly(shape, point, distance.hi);
}

template <class Shape>
bool decide_within(const Shape& shape, const Vec3d& point, double limit) {
  if (std::isinf(limit)) return limit > 0;
  const RoughDistance near = rough(shape, point);
  if (near.value - limit > near.error) return false;
  if (limit - near.value > near.error) return true;
  const auto [distance, scale] = measure<Double2>(shape, point);
  const double beyond = (distance - limit).hi;
  if (scale >= least_scale && std::fabs(beyond) > scale * fine_error) return beyond < 0;
  return exact_sign(shape, point, limit) <= 0;
}

}  // namespace

RoughDistance rough_distance(const Ball& ball, const Vec3d& point) { return rough(ball, point); }
RoughDistance rough_distance(const Capsule& capsule, const Vec3d& point) {
  return rough(capsule, point);
}
RoughDistance rough_distance(const Plane& plane, const Vec3d& point) { return rough(plane, point); }

double find_distance(const Ball& ball, const Vec3d& point) { return rounded(ball, point); }
double find_distance(const Capsule& capsule, const Vec3d& point) { return rounded(capsule, point); }
double find_distance(const Plane& plane, const Vec3d& point) { return rounded(plane, point); }

bool is_within(const Ball& ball, const Vec3d& point, double limit) {
  return decide_within(ball, point, limit);
}
bool is_within(const Capsule& capsule, const Vec3d& point, double limit) {
  return decide_within(capsule, point, limit);
}
bool is_within(const Plane& plane, const Vec3d& point, double limit) {
  return decide_within(plane, point, limit);
}

}  // namespace boule
