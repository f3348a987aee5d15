#pragma once

#include <string>

#include "bench/peers/contender.h"
#include "simd/abi/stream.h"

namespace boule::bench {

/// The least work with a nearest hit for every ray: all rays are read, each is solved once in
/// double, against one and the same sphere, and its answer is written. One for each instruction
/// set.
using OneSolve = void (*)(const RayStream& rays, const HitStream& hits);
namespace avx2 {
extern const OneSolve one_solve;
}
namespace avx512 {
extern const OneSolve one_solve;
}

/// The rate of that over the rays of a workload, in Mray/s of one thread's CPU time, the median of
/// some passes; 0 for rays that ask for any hit, most of which floats decide. Tracers whose rays
/// miss, and are not solved, can pass it. `isa`: avx2 or avx512.
double one_solve_rate(const Workload& workload, const std::string& isa);

}  // namespace boule::bench
