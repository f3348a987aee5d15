#pragma once

#include "bench/peers/referee.h"

namespace boule::bench {

/// For each instruction set of Boule a table: scenes by kinds of rays, the ratio of Form::automatic
/// to Embree, their least and their median. The widest set is held against the best of all of
/// Embree's modes, a narrower one against Embree limited to the same.
void print_summary(const Results& results, const RefereeSettings& settings);

}  // namespace boule::bench
