#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/base/platform.h"

namespace boule::elementary {

/// Elementary functions with the same bits on every machine: only + - * / and bit patterns, no
/// libm. Errors are measured against MPFR in the tests; the bounds stated here are tested. What a
/// function says of its arguments is a precondition: beyond it the result is any number, or NaN.

inline constexpr double pi = 3.141592653589793;

namespace detail {

/// An unevaluated sum hi + lo of two doubles.
struct DoubleDouble {
  double hi, lo;
};

/// a + b exactly, where |a| >= |b| (Dekker 1971).
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b exactly, for operands below 2^995 (Dekker 1971; Veltkamp's splitting).
inline DoubleDouble two_product(double a, double b) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double a_big = splitter * a, b_big = splitter * b;
  const double a_hi = a_big - (a_big - a), b_hi = b_big - (b_big - b);
  const double a_lo = a - a_hi, b_lo = b - b_hi;
  const double product = a * b;
  return {product, ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

/// a + b to about 2^-104 relative, where |a| >= |b|.
inline DoubleDouble add(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble sum = fast_two_sum(a.hi, b.hi);
  return fast_two_sum(sum.hi, sum.lo + (a.lo + b.lo));
}

/// a * b to about 2^-102 relative.
inline DoubleDouble multiply(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble product = two_product(a.hi, b.hi);
  return fast_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// The integer nearest to x, for |x| < 2^51.
inline double round_to_integer(double x) {
  constexpr double magic = 0x1.8p52;
  return (x + magic) - magic;
}

/// 2^k for -1022 <= k <= 1023.
inline double power_of_two(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

// ln 2 = ln2_hi + ln2_lo; ln2_hi has 11 trailing zero bits: times an exponent it is exact.
inline constexpr double ln2_hi = 0x1.62e42fefa3800p-1;
inline constexpr double ln2_lo = 0x1.ef35793c76730p-45;

/// log(x) for normal and denormal x > 0, with a relative error of about 2^-68. A power is wrong by
/// no more than 745 times that, because exp takes exponents up to 745: far below half an ulp.
inline DoubleDouble log_extended(double x) {
  int exponent = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    exponent = -54;
  }
  auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffff) | 0x3ff0000000000000);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  // log m = 2 atanh(s), s = (m - 1) / (m + 1), kept as s + s_lo.
  const double numerator = m - 1, denominator = m + 1;
  const double denominator_lo = m - (denominator - 1);
  const double s = numerator / denominator;
  const DoubleDouble back = two_product(s, denominator);
  const double s_lo = ((numerator - back.hi) - back.lo - s * denominator_lo) / denominator;
  DoubleDouble z = two_product(s, s);
  z.lo += 2 * s * s_lo;
  // atanh(s) / s = 1 + z (1/3 + z (1/5 + z tail)); plain doubles are enough for the tail.
  constexpr DoubleDouble third{1.0 / 3, 0x1.5555555555555p-56}, fifth{0.2, -0x1.999999999999ap-57};
  double tail = 0;
  for (int odd = 23; odd >= 7; odd -= 2) tail = tail * z.hi + 1.0 / odd;
  const DoubleDouble inner = add(third, multiply(z, add(fifth, {z.hi * tail, 0})));
  const DoubleDouble mantissa = multiply({2 * s, 2 * s_lo}, add({1, 0}, multiply(z, inner)));
  if (exponent == 0) return mantissa;
  const DoubleDouble sum = fast_two_sum(exponent * ln2_hi, mantissa.hi);
  return fast_two_sum(sum.hi, sum.lo + (mantissa.lo + exponent * ln2_lo));
}

/// exp(hi + lo) for a normalised pair; 0 and inf beyond the range of double.
inline double exp_extended(DoubleDouble x) {
  constexpr double inf = std::bit_cast<double>(0x7ff0000000000000);
  if (x.hi > 709.79) return inf;
  if (x.hi < -745.14) return 0;
  const double k = round_to_integer(x.hi * 1.4426950408889634);
  const double r_hi = x.hi - k * ln2_hi, r_lo = x.lo - k * ln2_lo;
  const double r = r_hi + r_lo, r_error = (r_hi - r) + r_lo;
  constexpr double factorial[] = {2,     6,      24,      120,      720,       5040,
                                  40320, 362880, 3628800, 39916800, 479001600, 6227020800};
  double series = 0;  // sum over n >= 2 of r^(n - 2) / n!
  for (int n = 11; n >= 0; --n) series = series * r + 1 / factorial[n];
  const DoubleDouble linear = fast_two_sum(1, r);
  const double value = linear.hi + (linear.lo + (r_error + r * r * series));
  const int whole = static_cast<int>(k), half = whole / 2;
  return value * power_of_two(half) * power_of_two(whole - half);
}

}  // namespace detail

/// e^x; error below 1 ulp where the result is normal. NaN for NaN.
inline double exp(double x) { return x != x ? x : detail::exp_extended({x, 0}); }

/// x^y for x >= 0; error below 1 ulp where the result is normal. x^0 = 1 and 0^y = 0 for y > 0; NaN
/// for x < 0 and for NaN.
inline double pow(double x, double y) {
  constexpr double inf = std::bit_cast<double>(0x7ff0000000000000);
  if (!(x >= 0) || y != y) return inf - inf;
  if (y == 0 || x == 1) return 1;
  if (x == 0 || x == inf) return (x == 0) == (y > 0) ? 0 : inf;
  const detail::DoubleDouble log = detail::log_extended(x);
  if (y > 1e290 || y < -1e290) return (log.hi > 0) == (y > 0) ? inf : 0;
  const detail::DoubleDouble product = detail::two_product(log.hi, y);
  return detail::exp_extended(detail::fast_two_sum(product.hi, product.lo + log.lo * y));
}

/// x^y for 0 < x <= 1 and y >= 0, for results that become floats: relative error below 2^-38 down
/// to 2^-200, and 0 far below that. A fraction of the time of pow().
inline double pow_for_float(double x, double y) {
  if (x < 0x1p-1022) return y > 0 ? 0 : 1;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto mantissa = bits & 0x000fffffffffffff;
  const std::uint64_t above_root_2 = mantissa > 0x6a09e667f3bcc ? 1 : 0;
  const double m = std::bit_cast<double>(mantissa | (1023 - above_root_2) << 52);
  const double exponent = static_cast<double>(static_cast<int>((bits >> 52) + above_root_2) - 1023);
  // log m = 2 atanh(s) = 2 s (1 + z / 3 + z^2 / 5 + ..), summed as a tree (Estrin 1960).
  const double s = (m - 1) / (m + 1), z = s * s, z2 = z * z, z4 = z2 * z2;
  const double low = (1 + z * (1.0 / 3)) + z2 * (1.0 / 5 + z * (1.0 / 7));
  const double high = (1.0 / 9 + z * (1.0 / 11)) + z2 * (1.0 / 13 + z * (1.0 / 15));
  constexpr double two_log2_e = 0x1.71547652b82fep1, ln2 = 0x1.62e42fefa39efp-1;
  const double log2 = exponent + two_log2_e * s * (low + z4 * (high + z4 * (1.0 / 17)));
  const double result = y * log2;
  if (!(result > -1000)) return 0;
  const double whole = detail::round_to_integer(result), r = (result - whole) * ln2, r2 = r * r;
  // e^r, likewise.
  const double a = (1 + r) + r2 * (1.0 / 2 + r * (1.0 / 6));
  const double b = (1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040));
  const double c = (1.0 / 40320 + r * (1.0 / 362880)) + r2 * (1.0 / 3628800 + r * (1.0 / 39916800));
  const double r4 = r2 * r2;
  return (a + r4 * (b + r4 * c)) * detail::power_of_two(static_cast<int>(whole));
}

/// tan(x) for 0 <= x < pi / 2, an acute angle in radians; error below 4 ulp.
inline double tan_acute(double x) {
  // pi / 2 = pio2_hi + pio2_lo: above pi / 4 the cotangent of the complement is used.
  constexpr double pio2_hi = 0x1.921fb54442d18p0, pio2_lo = 0x1.1a62633145c07p-54;
  const bool steep = x > pi / 4;
  const double a = steep ? (pio2_hi - x) + pio2_lo : x;
  const double z = a * a;
  double sine = 0, cosine = 0;  // Taylor: sin = a + a z sine, cos = 1 + z cosine
  for (int n = 19; n >= 3; n -= 2) sine = -(1 + z * sine) / (n * (n - 1));
  for (int n = 18; n >= 2; n -= 2) cosine = -(1 + z * cosine) / (n * (n - 1));
  const double sin_a = a + a * (z * sine), cos_a = 1 + z * cosine;
  return steep ? cos_a / sin_a : sin_a / cos_a;
}

/// The angle of (x, y) from the x axis, -pi to pi, both finite; 0 for (0, 0). Error below 1e-15.
/// The angle is halved twice, tan(a / 2) = tan a / (1 + sqrt(1 + tan^2 a)), before Taylor's series.
inline double atan2(double y, double x) {
  const double a = x < 0 ? -x : x, b = y < 0 ? -y : y;
  const bool steep = b > a;
  if (!(a > 0) && !(b > 0)) return 0;
  double t = steep ? a / b : b / a;
  for (int halving = 0; halving < 2; ++halving) t /= 1 + std::sqrt(1 + t * t);
  const double z = t * t;
  double sum = 0;
  for (int n = 23; n >= 1; n -= 2) sum = 1.0 / n - z * sum;
  double angle = 4 * t * sum;
  if (steep) angle = pi / 2 - angle;
  if (x < 0) angle = pi - angle;
  return y < 0 ? -angle : angle;
}

/// sin(x) / x for -pi / 2 <= x <= pi / 2, from z = x^2; T is double or lanes of it. x times the
/// result is sin(x) with an error below 3 ulp.
template <class T>
BOULE_INLINE T sine_ratio(T z) {
  T sum = T(1.0);
  for (int n = 23; n >= 3; n -= 2) sum = T(1.0) - z * T(1.0 / (n * (n - 1))) * sum;
  return sum;
}

/// cos(x) for -pi / 2 <= x <= pi / 2, from z = x^2, likewise; error below 2^-52.
template <class T>
BOULE_INLINE T cosine(T z) {
  T sum = T(1.0);
  for (int n = 24; n >= 2; n -= 2) sum = T(1.0) - z * T(1.0 / (n * (n - 1))) * sum;
  return sum;
}

}  // namespace boule::elementary
