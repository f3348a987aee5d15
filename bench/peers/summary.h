#pragma once

#include "bench/peers/referee.h"

namespace boule::bench {

/// For each instruction set of Boule a table: scenes by kinds of rays, the ratio of Form::automatic
/// to Embree, their least and their median. AVX2 is held against Embree limited to it, if that ran,
/// other sets against the best of all of Embree's modes.
void print_summary(const Results& results, const RefereeSettings& settings);

}  // namespace boule::bench
