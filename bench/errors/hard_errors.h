#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "simd/abi/isa.h"
#include "tests/oracle/hard_figures.h"
#include "tests/support/hard_cases.h"

namespace boule::bench {

/// The errors of one contender in one hard case; the bounds of rays do not count.
struct HardErrors {
  std::string contender;
  test::HardFigures figures;
};

/// The rows that every contender can answer: spheres, float origins, finite inputs, t > 0.
std::vector<test::HardCaseSpec> sphere_cases();

/// Every contender on pairs of a ray and the sphere that it is aimed at, ray i at sphere i %
/// spheres, judged by the oracle: our solvers first, then the ISA's solvers of textbooks.
/// Origins are floats.
std::vector<HardErrors> errors_of(test::HardCase pairs, Isa isa);

/// The same on `rays` pairs of a case.
std::vector<HardErrors> hard_errors(const test::HardCaseSpec& spec, std::size_t rays, Isa isa);

}  // namespace boule::bench
