#pragma once

#include <span>

#include "tests/support/case_random.h"
#include "tests/support/hard_cases.h"

namespace boule::test {

/// 10^k, correctly rounded for |k| <= 22.
inline double power_of_ten(int k) {
  double power = 1;
  for (int i = 0; i < (k < 0 ? -k : k); ++i) power *= 10;
  return k < 0 ? 1 / power : power;
}

/// A point at distance `magnitude` from the world's origin.
inline Vec3f far_point(CaseRandom& random, double magnitude) {
  const Vec3d direction = random.direction();
  return vec_cast<float>(direction * magnitude);
}

/// Rounds to float; the result is taken as exact.
inline Vec3d rounded(const Vec3d& v) { return vec_cast<double>(vec_cast<float>(v)); }

/// How a row draws its primitives, and the rays aimed at one of them.
template <class Primitive>
struct HardRow {
  const char* name;
  Primitive (*primitive)(CaseRandom& random, int k);
  Ray (*ray)(CaseRandom& random, const Primitive& primitive, int k);
};

std::span<const HardRow<Sphere>> sphere_rows();  ///< S0 .. S11
std::span<const HardRow<Plane>> plane_rows();    ///< P0 .. P6

/// S12: replaces each component by a special value with probability 1/4.
void spoil(CaseRandom& random, Sphere& sphere);
void spoil(CaseRandom& random, Plane& plane);
void spoil(CaseRandom& random, Ray& ray);

}  // namespace boule::test
