// Compiled once per instruction set, for the compiler to vectorise: the loops are short enough for
// their rays to stay in the nearest cache from one to the next.
#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/peers/ray_limit.h"

namespace boule::bench::BOULE_KERNEL_ISA {
namespace {

constexpr std::size_t block = 256;  ///< rays

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
    t[k] = hit ? root : std::numeric_limits<double>::infinity();
  }
}

/// What tells a ray not to meet the sphere that it leaves. Here no ray leaves this one.
void leave_out_sources(const RayStream& rays, std::size_t first, std::size_t size,
                       std::uint32_t* __restrict leaves) {
  const std::int32_t* source = rays.source + first;
  const std::uint8_t* inside = rays.inside + first;
  for (std::size_t k = 0; k < size; ++k)
    leaves[k] = static_cast<std::uint32_t>(source[k] == std::numeric_limits<std::int32_t>::max()) &
                inside[k];
}

void closest(const RayStream& rays, const HitStream& hits) {
  std::uint32_t leaves[block];
  for (std::size_t first = 0; first < rays.size; first += block) {
    const std::size_t size = std::min(block, rays.size - first);
    double* const t = hits.t + first;
    solve(rays, first, size, t);
    leave_out_sources(rays, first, size, leaves);
    for (std::size_t k = 0; k < size; ++k) {
      const bool hit = t[k] < std::numeric_limits<double>::infinity();
      hits.id[first + k] = hit ? static_cast<std::int32_t>(leaves[k]) : -1;
      hits.slot[first + k] = leaves[k];
    }
  }
}

void any(const RayStream& rays, std::uint8_t* occluded) {
  std::uint32_t leaves[block];
  double t[block];
  for (std::size_t first = 0; first < rays.size; first += block) {
    const std::size_t size = std::min(block, rays.size - first);
    solve(rays, first, size, t);
    leave_out_sources(rays, first, size, leaves);
    for (std::size_t k = 0; k < size; ++k)
      occluded[first + k] = t[k] < std::numeric_limits<double>::infinity() && leaves[k] == 0;
  }
}

}  // namespace

extern const LimitKernel limit_kernel;
const LimitKernel limit_kernel = {closest, any};

}  // namespace boule::bench::BOULE_KERNEL_ISA
