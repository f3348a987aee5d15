#pragma once

#include <cstddef>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::test {

/// Hard cases of capsules, as HardCase has those of spheres: rays[i] is aimed at
/// capsules[i % size]. Inputs are floats.
///
///   C0  ordinary: r .5..2, L / r .1..20, F 3..30
///   C1  distant: F / r = 10^k
///   C2  the ray along the tube, at a sine of 10^-k
///   C3  a needle: L / r = 10^k
///   C4  a disc: L / r = 10^-k
///   C5  tangent to the tube: 1 +/- 2^-k of r from the axis
///   C6  at the seam: s within 2^-k of an end
///   C7  the origin on the axis, within the capsule, or near its surface
///   C8  a = b: a sphere
///   C9  C0 times 10^k
///   C10 far from the world's origin: 10^k
struct CapsuleCaseSpec {
  const char* row;
  int k = 0;
};
inline void PrintTo(const CapsuleCaseSpec& spec, std::ostream* out) { *out << spec.row << spec.k; }
std::string name_of(const CapsuleCaseSpec& spec);

struct CapsuleCase {
  std::vector<Capsule> capsules;
  std::vector<Ray> rays;
};

std::span<const CapsuleCaseSpec> capsule_case_specs();
CapsuleCase make_capsule_case(const CapsuleCaseSpec& spec, std::size_t capsules, std::size_t rays);

}  // namespace boule::test
