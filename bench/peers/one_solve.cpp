#include "bench/peers/one_solve.h"

#include <vector>

#include "bench/tools/median.h"
#include "bench/tools/thread_seconds.h"

namespace boule::bench {

double one_solve_rate(const Workload& workload, const std::string& isa) {
  if (asks_any(workload.kind)) return 0;
  constexpr int passes = 5;
  const OneSolve solve = isa == "avx512" ? avx512::one_solve : avx2::one_solve;
  const RayStream rays = workload.rays->view();
  HitBuffer hits(rays.size);
  std::vector<double> seconds;
  for (int pass = 0; pass < passes; ++pass) {
    const double begin = thread_seconds();
    solve(rays, hits.view());
    seconds.push_back(thread_seconds() - begin);
  }
  return 1e-6 * static_cast<double>(rays.size) / median(seconds);
}

}  // namespace boule::bench
