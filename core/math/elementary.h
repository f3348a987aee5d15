#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "core/base/platform.h"
#include "core/math/error_free.h"
#include "core/math/number.h"

namespace boule::elementary {

/// Elementary functions with the same bits on every machine: only + - * / and bit patterns, without
/// libm. The tests measure the errors against MPFR and check the bounds stated here. The stated
/// ranges of arguments are preconditions: beyond them the result is any number, or NaN.

inline constexpr double pi = 3.141592653589793;

namespace detail {

/// a + b to about 2^-104 relative, where |a| >= |b|.
template <class T>
BOULE_INLINE SumOf<T> add(const SumOf<T>& a, const SumOf<T>& b) {
  const SumOf<T> sum = fast_two_sum(a.hi, b.hi);
  return fast_two_sum(sum.hi, sum.lo + (a.lo + b.lo));
}

/// The integer nearest to x, for |x| < 2^51.
template <class T>
BOULE_INLINE T round_to_integer(const T& x) {
  const T magic(0x1.8p52);
  return (x + magic) - magic;
}

// ln 2 = ln2_hi + ln2_lo; ln2_hi has 11 trailing zero bits: times an exponent it is exact.
inline constexpr double ln2_hi = 0x1.62e42fefa3800p-1;
inline constexpr double ln2_lo = 0x1.ef35793c76730p-45;

/// log(m) for m from sqrt(1/2) to sqrt(2).
template <class T>
BOULE_INLINE SumOf<T> log_of_mantissa(const T& m) {
  // log m = 2 atanh(s), s = (m - 1) / (m + 1), kept as s + s_lo.
  const T numerator = m - T(1.0), denominator = m + T(1.0);
  const T denominator_lo = m - (denominator - T(1.0));
  const T s = numerator / denominator;
  const SumOf<T> back = two_product(s, denominator);
  const T s_lo = ((numerator - back.hi) - back.lo - s * denominator_lo) / denominator;
  SumOf<T> z = two_product(s, s);
  z.lo = z.lo + T(2.0) * s * s_lo;
  // atanh(s) / s = 1 + z (1/3 + z (1/5 + z tail)); plain doubles are enough for the tail.
  const SumOf<T> third{T(1.0 / 3), T(0x1.5555555555555p-56)};
  const SumOf<T> fifth{T(0.2), T(-0x1.999999999999ap-57)};
  T tail(0.0);
  for (int odd = 23; odd >= 7; odd -= 2) tail = tail * z.hi + T(1.0 / odd);
  const SumOf<T> inner = add(third, multiply(z, add(fifth, {z.hi * tail, T(0.0)})));
  return multiply({T(2.0) * s, T(2.0) * s_lo}, add({T(1.0), T(0.0)}, multiply(z, inner)));
}

/// log(x) for normal and denormal x > 0, with a relative error of about 2^-68. A power has an error
/// of at most 745 times that, because exp takes exponents up to 745: far below half an ulp.
template <class T>
BOULE_INLINE SumOf<T> log_extended(const T& given) {
  const Mask<T> denormal = given < T(0x1p-1022);
  const T x = select(denormal, given * T(0x1p54), given);
  const T whole = mantissa(x);
  const Mask<T> above_root_2 = T(1.4142135623730951) < whole;
  const SumOf<T> log = log_of_mantissa(select(above_root_2, whole * T(0.5), whole));
  const T exponent = biased_exponent(x) - select(denormal, T(1023.0 + 54), T(1023.0)) +
                     select(above_root_2, T(1.0), T(0.0));
  const SumOf<T> sum = fast_two_sum(exponent * T(ln2_hi), log.hi);
  const SumOf<T> all = fast_two_sum(sum.hi, sum.lo + (log.lo + exponent * T(ln2_lo)));
  const Mask<T> none = exponent == T(0.0);
  return {select(none, log.hi, all.hi), select(none, log.lo, all.lo)};
}

/// exp(hi + lo) for a normalised pair; 0 and inf beyond the range of double.
template <class T>
BOULE_INLINE T exp_extended(const SumOf<T>& x) {
  constexpr double inf = std::bit_cast<double>(0x7ff0000000000000);
  const Mask<T> above = T(709.79) < x.hi, below = x.hi < T(-745.14);
  const T k = select(above | below, T(0.0), round_to_integer(x.hi * T(1.4426950408889634)));
  const T r_hi = x.hi - k * T(ln2_hi), r_lo = x.lo - k * T(ln2_lo);
  const T r = r_hi + r_lo, r_error = (r_hi - r) + r_lo;
  constexpr double factorial[] = {2,     6,      24,      120,      720,       5040,
                                  40320, 362880, 3628800, 39916800, 479001600, 6227020800};
  T series(0.0);  // sum over n >= 2 of r^(n - 2) / n!
  for (int n = 11; n >= 0; --n) series = series * r + T(1 / factorial[n]);
  const SumOf<T> linear = fast_two_sum(T(1.0), r);
  const T value = linear.hi + (linear.lo + (r_error + r * r * series));
  const T half = round_to_integer(k * T(0.5));
  const T power = value * power_of_two(half) * power_of_two(k - half);
  return select(above, T(inf), select(below, T(0.0), power));
}

}  // namespace detail

/// e^x; error below 1 ulp where the result is normal. NaN for NaN.
inline double exp(double x) { return x != x ? x : detail::exp_extended<double>({x, 0}); }

/// x^y for x >= 0; error below 1 ulp where the result is normal. x^0 = 1 and 0^y = 0 for y > 0; NaN
/// for x < 0 and for NaN. T is double or lanes of it.
template <class T>
requires(!std::is_integral_v<T>)  // whole numbers count as double
    BOULE_INLINE T pow(const T& x, const T& y) {
  constexpr double inf = std::bit_cast<double>(0x7ff0000000000000);
  const T zero(0.0), one(1.0);
  const SumOf<T> log = detail::log_extended(x);
  const SumOf<T> product = two_product(log.hi, y);
  const T ordinary = detail::exp_extended(fast_two_sum(product.hi, product.lo + log.lo * y));
  // Numbers that two_product() cannot take.
  const Mask<T> up = zero < y, grows = select(zero < log.hi, up, y <= zero);
  const T huge = select(grows, T(inf), zero);
  const T finite = select((T(1e290) < y) | (y < T(-1e290)), huge, ordinary);
  const T at_end = select(select(x == zero, up, y <= zero), zero, T(inf));
  const T known = select((x == zero) | (x == T(inf)), at_end, finite);
  const T power = select((y == zero) | (x == one), one, known);
  return select((zero <= x) & ((y <= zero) | (zero < y)), power, T(inf - inf));
}

inline double pow(double x, double y) { return pow<double>(x, y); }

/// x^y for 0 <= x <= 1 and y >= 0, for results that become floats: relative error below 2^-38 down
/// to 2^-200, and 0 far below that. A fraction of the time of pow(). T is double or lanes of it.
template <class T>
requires(!std::is_integral_v<T>)  // whole numbers count as double
    BOULE_INLINE T pow_for_float(const T& x, const T& y) {
  const T whole = mantissa(x);
  const Mask<T> above_root_2 = T(0x1.6a09e667f3bccp0) < whole;
  const T m = select(above_root_2, whole * T(0.5), whole);
  const T exponent = (biased_exponent(x) + select(above_root_2, T(1.0), T(0.0))) - T(1023.0);
  // log m = 2 atanh(s) = 2 s (1 + z / 3 + z^2 / 5 + ..), summed as a tree (Estrin 1960).
  const T one(1.0), s = (m - one) / (m + one), z = s * s, z2 = z * z, z4 = z2 * z2;
  const T low = (one + z * T(1.0 / 3)) + z2 * (T(1.0 / 5) + z * T(1.0 / 7));
  const T high = (T(1.0 / 9) + z * T(1.0 / 11)) + z2 * (T(1.0 / 13) + z * T(1.0 / 15));
  constexpr double two_log2_e = 0x1.71547652b82fep1, ln2 = 0x1.62e42fefa39efp-1;
  const T log2 = exponent + T(two_log2_e) * s * (low + z4 * (high + z4 * T(1.0 / 17)));
  const T product = y * log2;
  const Mask<T> in_range = T(-1000.0) < product;
  const T result = select(in_range, product, T(0.0));
  const T k = detail::round_to_integer(result), r = (result - k) * T(ln2), r2 = r * r;
  // e^r, likewise.
  const T a = (one + r) + r2 * (T(1.0 / 2) + r * T(1.0 / 6));
  const T b = (T(1.0 / 24) + r * T(1.0 / 120)) + r2 * (T(1.0 / 720) + r * T(1.0 / 5040));
  const T c =
      (T(1.0 / 40320) + r * T(1.0 / 362880)) + r2 * (T(1.0 / 3628800) + r * T(1.0 / 39916800));
  const T r4 = r2 * r2;
  const T power = select(in_range, (a + r4 * (b + r4 * c)) * power_of_two(k), T(0.0));
  return select(x < T(0x1p-1022), select(T(0.0) < y, T(0.0), one), power);
}

inline double pow_for_float(double x, double y) { return pow_for_float<double>(x, y); }

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
