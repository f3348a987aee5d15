#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "bench/peers/contender.h"
#include "simd/abi/stream.h"

namespace boule::bench {

/// What no tracer of rays in memory can do without, by itself: every ray is read, solved once in
/// double, against one and the same sphere, and its answer is written.
struct LimitKernel {
  void (*closest)(const RayStream& rays, const HitStream& hits);
  void (*any)(const RayStream& rays, std::uint8_t* occluded);
};
namespace avx2 {
extern const LimitKernel limit_kernel;
}
namespace avx512 {
extern const LimitKernel limit_kernel;
}

/// The rate of that over the rays of a workload, in Mray/s of one thread's CPU time, the best of
/// some passes. `isa`: avx2 or avx512.
double limit_of(const Workload& workload, const std::string& isa);

}  // namespace boule::bench
