#pragma once

#include <cmath>
#include <limits>

#include "core/math/error_free.h"

namespace boule {

/// A sum of two doubles, the second of which is below half an ulp of the first.
struct Double2 : SumOf<double> {
  Double2() : Double2(0.0) {}
  Double2(double x) : Double2(x, 0.0) {}
  Double2(double high, double low) : SumOf{high, low} {}
  Double2(const SumOf<double>& sum) : SumOf(sum) {}
};

/// a + b without error (Knuth, TAOCP 2, 4.2.2).
inline Double2 two_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// Each within a few 2^-104 of the exact result, relative to it.
inline Double2 operator+(const Double2& a, const Double2& b) {
  const Double2 high = two_sum(a.hi, b.hi), low = two_sum(a.lo, b.lo);
  const Double2 sum = fast_two_sum(high.hi, high.lo + low.hi);
  return fast_two_sum(sum.hi, sum.lo + low.lo);
}
inline Double2 operator-(const Double2& a) { return {-a.hi, -a.lo}; }
inline Double2 operator-(const Double2& a, const Double2& b) { return a + -b; }
inline Double2 operator*(const Double2& a, const Double2& b) { return multiply<double>(a, b); }
inline Double2 operator/(const Double2& a, const Double2& b) {
  const double first = a.hi / b.hi;
  const Double2 rest = a - b * first;
  const double second = rest.hi / b.hi;
  const double third = (rest - b * second).hi / b.hi;
  return fast_two_sum(first, second) + third;
}

inline double root(double a) { return std::sqrt(a); }
inline Double2 root(const Double2& a) {
  const double near = std::sqrt(a.hi);
  if (near == 0) return 0;
  return fast_two_sum(near, (a - two_product(near, near)).hi / (2 * near));
}

/// The sign of a number that is not known.
inline constexpr int unknown_sign = 2;

/// A double that is exact, or NaN: each result that would be rounded is NaN.
class UnroundedDouble {
 public:
  UnroundedDouble(double x) : value_(x) {}

  /// -1, 0, 1 or unknown_sign.
  [[nodiscard]] int sign() const {
    if (std::isnan(value_)) return unknown_sign;
    return value_ > 0 ? 1 : (value_ < 0 ? -1 : 0);
  }

  friend UnroundedDouble operator+(UnroundedDouble a, UnroundedDouble b) {
    return exact(two_sum(a.value_, b.value_));
  }
  friend UnroundedDouble operator-(UnroundedDouble a, UnroundedDouble b) {
    return exact(two_sum(a.value_, -b.value_));
  }
  /// Products close to underflow, whose errors cannot be seen, are NaN, too.
  friend UnroundedDouble operator*(UnroundedDouble a, UnroundedDouble b) {
    constexpr double least = 0x1p-900;
    if (a.value_ == 0 || b.value_ == 0) return a.value_ * b.value_;
    const Double2 product = two_product(a.value_, b.value_);
    if (!(std::fabs(product.hi) > least)) return std::numeric_limits<double>::quiet_NaN();
    return exact(product);
  }

 private:
  static UnroundedDouble exact(const Double2& x) {
    return x.lo == 0 ? x.hi : std::numeric_limits<double>::quiet_NaN();
  }

  double value_;
};

}  // namespace boule
