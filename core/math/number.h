#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/base/platform.h"
#include "core/math/vec.h"

namespace boule {

/// A formula that a double and W doubles at a time (Wide, in simd/lanes) have in common is written
/// once, as a template over the number type. The type must have + - * /, the ordered comparisons <
/// <= ==, and the functions below, here for double; simd/lanes has the same functions for Wide. A
/// formula is free of branches on numbers: it computes both sides and selects.

/// The type of a comparison's result: bool, or one truth value per lane.
template <class T>
using Mask = decltype(std::declval<T>() < std::declval<T>());

BOULE_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
BOULE_INLINE float select(bool mask, float a, float b) { return mask ? a : b; }
BOULE_INLINE bool select(bool mask, bool a, bool b) { return mask ? a : b; }
/// True if the mask is set in some lane. Formulas may use it to skip computations that all lanes
/// can do without.
BOULE_INLINE bool any(bool mask) { return mask; }
/// The inverted mask.
BOULE_INLINE bool complement(bool mask) { return !mask; }
BOULE_INLINE double sqrt(double a) { return std::sqrt(a); }
BOULE_INLINE double abs(double a) { return std::fabs(a); }
BOULE_INLINE double copysign(double magnitude, double sign) {
  return std::copysign(magnitude, sign);
}

/// Conversions: to float by rounding, and back. A mask of doubles becomes one of floats.
BOULE_INLINE float narrow(double a) { return static_cast<float>(a); }
BOULE_INLINE bool narrow(bool mask) { return mask; }
BOULE_INLINE double widen(float a) { return static_cast<double>(a); }

/// float, or W floats.
template <class T>
using Single = decltype(narrow(std::declval<T>()));

// For a positive normal number m 2^e, with m in [1, 2): e + 1023, and m. For any other number: an
// undefined number.
BOULE_INLINE double biased_exponent(double a) {
  return static_cast<double>(std::bit_cast<std::uint64_t>(a) >> 52);
}
BOULE_INLINE double mantissa(double a) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a) & 0x000fffffffffffff) |
                               0x3ff0000000000000);
}
/// 2^k for whole k from -1022 to 1023; otherwise an undefined number.
BOULE_INLINE double power_of_two(double k) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(k + (0x1p52 + 1023)) << 52);
}

/// n numbers of one type.
template <class T, std::size_t n>
struct Numbers {
  T at[n];
};

/// One lane of Numbers in memory: number k is first[k * step].
struct SpacedNumbers {
  double* first;
  std::size_t step;
  BOULE_INLINE double& operator[](std::size_t k) const { return first[k * step]; }
};

/// Looks `count` numbers up in a table in memory by n given ones. find(given, found) does so for
/// one lane: it reads the numbers of one SpacedNumbers and sets those of the other.
template <std::size_t count, std::size_t n, class Find>
BOULE_INLINE Numbers<double, count> look_up(Numbers<double, n> given, const Find& find) {
  Numbers<double, count> found;
  find(SpacedNumbers{given.at, 1}, SpacedNumbers{found.at, 1});
  return found;
}

// Functions that follow from these, for any number type.

template <class M, class T>
BOULE_INLINE Vec3<T> select(const M& mask, const Vec3<T>& a, const Vec3<T>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

template <class T>
BOULE_INLINE Vec3<Single<T>> narrow(const Vec3<T>& v) {
  return {narrow(v.x), narrow(v.y), narrow(v.z)};
}

/// The larger of a number and 0; 0 for NaN.
template <class T>
BOULE_INLINE T positive(const T& a) {
  return select(T(0.0) < a, a, T(0.0));
}

}  // namespace boule
