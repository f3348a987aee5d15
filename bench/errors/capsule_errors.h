#pragma once

#include <cstddef>
#include <vector>

#include "bench/errors/hard_errors.h"
#include "tests/support/hard_capsules.h"

namespace boule::bench {

/// Every contender on `rays` pairs of a hard case of capsules, judged by the oracle: our solver by
/// the widest kernels, the solver of textbooks in float and in double, and Embree's round linear
/// curves where this build has Embree. Origins are floats; the bounds of rays do not count.
std::vector<HardErrors> capsule_errors(const test::CapsuleCaseSpec& spec, std::size_t rays);

}  // namespace boule::bench
