#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "simd/abi/isa.h"
#include "tests/oracle/hard_figures.h"
#include "tests/support/hard_cases.h"

namespace boule::bench {

/// What one contender did wrong in one hard case, the bounds of its rays aside.
struct HardErrors {
  std::string contender;
  test::HardFigures figures;
};

/// Rows that every contender can be asked: spheres, float origins, finite inputs, t > 0.
std::vector<test::HardCaseSpec> sphere_cases();

/// Every contender on pairs of a ray and the sphere that it is aimed at, ray i at sphere i %
/// spheres, judged by 1400 bits: our solvers first, then those of textbooks, as the ISA has them.
/// Origins are floats.
std::vector<HardErrors> errors_of(test::HardCase pairs, Isa isa);

/// The same on `rays` pairs of a case.
std::vector<HardErrors> hard_errors(const test::HardCaseSpec& spec, std::size_t rays, Isa isa);

}  // namespace boule::bench
