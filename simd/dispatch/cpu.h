#pragma once

#include "simd/abi/isa.h"

namespace boule {

/// True if this CPU, and the operating system's handling of its registers, can run `isa`.
bool cpu_supports(Isa isa);

}  // namespace boule
