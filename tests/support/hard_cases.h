#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::test {

/// One row of the hard-case suite at one parameter. rays[i] is aimed at spheres[i % size], or at
/// planes[i % size] where there are no spheres. All inputs are floats (the origins of rows S11 and
/// L doubles), taken as exact.
struct HardCase {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  std::vector<Ray> rays;
};

/// A case by name: the row, its parameter, and the hash of its first inputs (hash_test.cpp), the
/// same on every machine.
///
///   S0       ordinary: r .5..2 at F 3..30, impact parameter beta r, beta 0..1.2
///   S1       distant: r = 1, F = 2 10^k
///   S2       ground sphere R = 10^k, the eye within 5 units of its top, half of the rays grazing
///   S3       tiny: r = 10^-k, F = 3
///   S4, S4b  tangent: beta = 1 +/- 2^-k, F = 10, 1000
///   S5       origin on the surface: o = fl(c + n), |c| ~ 10^k
///   S6       origin near the surface: F = r (1 +/- 2^-k)
///   S7       origin at the centre, |d| and r = 10^U(-3, 3)
///   S8       |d| = 10^k
///   S9       S0 times 10^k
///   S10      far from the origin: |c| ~ 10^k, r = 1
///   S11      secondary rays, inward and outward, from a ground sphere R = 10^k
///   S12      special values (NaN, inf, 0, denormals, 3e38, 1e19 ..) in a quarter of all components
///   S13      beyond the float filter's range, r^2 just below 2^128: F = 4 r 10^k
///   P0       ordinary plane    P1  n.d = 2^-k          P2  origin on the plane, |p| ~ 10^k
///   P3       offset 10^k       P4  |n| = 10^k          P5  the ground y = 0, half grazing
///   P6       P0 times 10^k
///   L        secondary rays that leave any of a crowd of spheres and planes
struct HardCaseSpec {
  const char* row;
  int k = 0;
  std::uint64_t inputs = 0;
};

/// "S4_k12", "S8_km3": fit for a test's name.
std::string name_of(const HardCaseSpec& spec);
inline void PrintTo(const HardCaseSpec& spec, std::ostream* out) { *out << name_of(spec); }

/// Every row at all its parameters.
std::span<const HardCaseSpec> hard_case_specs();

/// Rays that leave a surface: where t ~ 0 matters an oracle has no say, the contract has.
bool leaves_surfaces(const HardCaseSpec& spec);

/// Primitives and rays: at least 1. Rows S2, S11 and P5 have one primitive whatever is asked.
/// Primitive j and ray i are the same in a case of any size with as many primitives.
HardCase make_hard_case(const HardCaseSpec& spec, std::size_t primitives, std::size_t rays);

}  // namespace boule::test
