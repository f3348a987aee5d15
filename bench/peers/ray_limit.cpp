#include "bench/peers/ray_limit.h"

#include <algorithm>

#include "bench/thread_seconds.h"
#include "simd/stream/aligned_array.h"

namespace boule::bench {

double limit_of(const Workload& workload, const std::string& isa) {
  constexpr int passes = 5;
  const LimitKernel& kernel = isa == "avx512" ? avx512::limit_kernel : avx2::limit_kernel;
  const RayStream rays = workload.rays->view();
  HitBuffer hits(rays.size);
  AlignedArray<std::uint8_t> occluded(rays.size);
  double least = 0;
  for (int pass = 0; pass < passes; ++pass) {
    const double begin = thread_seconds();
    if (asks_any(workload.kind)) {
      kernel.any(rays, occluded.data());
    } else {
      kernel.closest(rays, hits.view());
    }
    const double seconds = thread_seconds() - begin;
    least = pass == 0 ? seconds : std::min(least, seconds);
  }
  return 1e-6 * static_cast<double>(rays.size) / least;
}

}  // namespace boule::bench
