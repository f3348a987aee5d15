#pragma once

#include "core/base/platform.h"

namespace boule {

/// Sums and products with their rounding errors, of doubles or lanes of doubles.

/// An unevaluated sum hi + lo of two numbers.
template <class T>
struct SumOf {
  T hi, lo;
};

/// a + b exactly, where |a| >= |b| (Dekker 1971).
template <class T>
BOULE_INLINE SumOf<T> fast_two_sum(const T& a, const T& b) {
  const T sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b exactly, for operands below 2^995 (Dekker 1971; Veltkamp's splitting).
template <class T>
BOULE_INLINE SumOf<T> two_product(const T& a, const T& b) {
  const T splitter(134217729.0);  // 2^27 + 1
  const T a_big = splitter * a, b_big = splitter * b;
  const T a_hi = a_big - (a_big - a), b_hi = b_big - (b_big - b);
  const T a_lo = a - a_hi, b_lo = b - b_hi;
  const T product = a * b;
  return {product, ((a_hi * b_hi - product) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

/// a * b to about 2^-102 relative.
template <class T>
BOULE_INLINE SumOf<T> multiply(const SumOf<T>& a, const SumOf<T>& b) {
  const SumOf<T> product = two_product(a.hi, b.hi);
  return fast_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

}  // namespace boule
