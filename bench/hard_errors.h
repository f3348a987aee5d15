#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "simd/abi/isa.h"
#include "tests/support/hard_cases.h"

namespace boule::bench {

/// Three columns: what one contender did wrong in one hard case. See tests/oracle/hard_figures.h.
struct HardErrors {
  std::string contender;
  std::size_t pairs = 0, hits = 0;
  std::size_t wrong_decisions = 0, wrong_roots = 0;
  double ulp_p50 = 0, ulp_p99 = 0, ulp_max = 0;  ///< of float t
  double residual = 0;                           ///< of float t, in u max(F, r)
};

/// Rows that every contender can be asked: spheres, float origins, finite inputs, t > 0.
std::vector<test::HardCaseSpec> sphere_cases();

/// Every contender on `rays` pairs of a case, judged by 1400 bits: our solvers first, then those of
/// textbooks, as the ISA has them.
std::vector<HardErrors> hard_errors(const test::HardCaseSpec& spec, std::size_t rays, Isa isa);

}  // namespace boule::bench
