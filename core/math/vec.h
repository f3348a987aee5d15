#pragma once

#include "core/base/platform.h"

namespace boule {

/// Three components of any lane type: float, double, or a register of either. Components may be any
/// numbers: all operations follow IEEE 754, NaN and overflow included.
template <class T>
struct Vec3 {
  T x{}, y{}, z{};
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class T>
BOULE_INLINE Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class T>
BOULE_INLINE Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class T>
BOULE_INLINE Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}

template <class T>
BOULE_INLINE Vec3<T> operator*(const Vec3<T>& a, const T& s) {
  return {a.x * s, a.y * s, a.z * s};
}

/// (a.x b.x + a.y b.y) + a.z b.z, in this order: the order is part of "same bits everywhere".
template <class T>
BOULE_INLINE T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Right-handed cross product.
template <class T>
BOULE_INLINE Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Component-wise conversion: exact from float to double, rounded to nearest the other way.
template <class To, class From>
BOULE_INLINE Vec3<To> vec_cast(const Vec3<From>& a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

/// Exact equality, component by component.
template <class T>
BOULE_INLINE bool operator==(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

}  // namespace boule
