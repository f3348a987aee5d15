#pragma once

#include <string>

#include "bench/report/figures.h"

namespace boule::bench {

/// What each solver gets wrong over all hard cases, on the widest ISA, beside its speed on the main
/// scene: an HTML table.
std::string solver_table(Figures& figures);

}  // namespace boule::bench
