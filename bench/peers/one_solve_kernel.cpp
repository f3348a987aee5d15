// Compiled once per instruction set, for the compiler to vectorise: the loops are short enough for
// their rays to stay in the nearest cache from one to the next.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/peers/one_solve.h"

namespace boule::bench::BOULE_KERNEL_ISA {
namespace {

constexpr std::size_t block = 256;  ///< rays
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The nearest root of each ray, or infinity; `size` at most `block`.
void solve(const RayStream& rays, std::size_t first, std::size_t size, double* __restrict t) {
  constexpr double x = 0.5, y = 0.5, z = 0.5, radius_squared = 0.04;
  const double *ox = rays.org_x + first, *oy = rays.org_y + first, *oz = rays.org_z + first;
  const float *dx = rays.dir_x + first, *dy = rays.dir_y + first, *dz = rays.dir_z + first;
  const float *tmin = rays.tmin + first, *tmax = rays.tmax + first;
  for (std::size_t k = 0; k < size; ++k) {
    const double fx = x - ox[k], fy = y - oy[k], fz = z - oz[k];
    const double hx{dx[k]}, hy{dy[k]}, hz{dz[k]};
    const double a = hx * hx + hy * hy + hz * hz, b = fx * hx + fy * hy + fz * hz;
    const double c = fx * fx + fy * fy + fz * fz - radius_squared;
    const double discriminant = b * b - a * c;
    const double root = (b - std::sqrt(discriminant < 0 ? 0 : discriminant)) / a;
    const bool hit = (discriminant >= 0) & (root > double{tmin[k]}) & (root <= double{tmax[k]});
    t[k] = hit ? root : infinity;
  }
}

/// Reads which primitive each ray leaves, for what that costs, and writes an id that depends on it.
void name(const RayStream& rays, std::size_t first, std::size_t size, const double* t,
          std::int32_t* __restrict id) {
  const std::int32_t* source = rays.source + first;
  const std::uint8_t* inside = rays.inside + first;
  for (std::size_t k = 0; k < size; ++k) {
    const std::int32_t found = (source[k] == 0) & inside[k];
    id[k] = t[k] < infinity ? found : no_primitive;
  }
}

void read_solve_write(const RayStream& rays, const HitStream& hits) {
  for (std::size_t first = 0; first < rays.size; first += block) {
    const std::size_t size = std::min(block, rays.size - first);
    solve(rays, first, size, hits.t + first);
    name(rays, first, size, hits.t + first, hits.id + first);
    std::fill_n(hits.slot + first, size, 0U);
  }
}

}  // namespace

extern const OneSolve one_solve;
const OneSolve one_solve = read_solve_write;

}  // namespace boule::bench::BOULE_KERNEL_ISA
