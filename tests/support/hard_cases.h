#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/ray.h"
#include "core/scene/primitive.h"

namespace boule::test {

/// One row of the hard-case suite at one parameter: rays[i] is aimed at spheres[i % spheres.size()]
/// (or at planes[..] where there are no spheres). All inputs are floats, taken as exact.
struct HardCase {
  std::vector<Sphere> spheres;
  std::vector<Plane> planes;
  std::vector<Ray> rays;
};

/// The name of a row and its parameter.
struct HardCaseSpec {
  const char* row;  ///< "S0" .. "S12", "P0" .. "P6", "L" (rays leaving surfaces)
  int k = 0;        ///< the row's exponent
};

/// "S4_k12", fit for a test's name.
std::string name_of(const HardCaseSpec& spec);

/// The rows at all their parameters.
std::vector<HardCaseSpec> hard_case_specs();

/// The same pairs on every machine for the same seed. Primitives and rays: at least 1.
HardCase make_hard_case(const HardCaseSpec& spec, std::size_t primitives, std::size_t rays,
                        std::uint64_t seed = 1);

}  // namespace boule::test
