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
template <CommonPart common>
void solve(const RayStream& rays, std::size_t first, std::size_t size, double* __restrict t) {
  constexpr double x = 0.5, y = 0.5, z = 0.5, radius_squared = 0.04;
  const RayPlaces at = rays.places(first);
  const double *ox = rays.org_x + at.org, *oy = rays.org_y + at.org, *oz = rays.org_z + at.org;
  const float *dx = rays.dir_x + at.dir, *dy = rays.dir_y + at.dir, *dz = rays.dir_z + at.dir;
  const float *tmin = rays.tmin + at.start, *tmax = rays.tmax + first;
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t org = common == CommonPart::origin ? 0 : k;
    const std::size_t dir = common == CommonPart::direction ? 0 : k;
    const std::size_t start = common != CommonPart::none ? 0 : k;
    const double fx = x - ox[org], fy = y - oy[org], fz = z - oz[org];
    const double hx{dx[dir]}, hy{dy[dir]}, hz{dz[dir]};
    const double a = hx * hx + hy * hy + hz * hz, b = fx * hx + fy * hy + fz * hz;
    const double c = fx * fx + fy * fy + fz * fz - radius_squared;
    const double discriminant = b * b - a * c;
    const double root = (b - std::sqrt(discriminant < 0 ? 0 : discriminant)) / a;
    const bool hit = (discriminant >= 0) & (root > double{tmin[start]}) & (root <= double{tmax[k]});
    t[k] = hit ? root : infinity;
  }
}

/// Reads which primitive each ray leaves, for what that costs, and writes an id that depends on it.
template <CommonPart common>
void name(const RayStream& rays, std::size_t first, std::size_t size, const double* t,
          std::int32_t* __restrict id) {
  const std::size_t at = rays.places(first).start;
  const std::int32_t* source = rays.source + at;
  const std::uint8_t* inside = rays.inside + at;
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t start = common != CommonPart::none ? 0 : k;
    const std::int32_t found = (source[start] == 0) & inside[start];
    id[k] = t[k] < infinity ? found : no_primitive;
  }
}

template <CommonPart common>
void read_solve_write(const RayStream& rays, const HitStream& hits) {
  for (std::size_t first = 0; first < rays.size; first += block) {
    const std::size_t size = std::min(block, rays.size - first);
    solve<common>(rays, first, size, hits.t + first);
    name<common>(rays, first, size, hits.t + first, hits.id + first);
    std::fill_n(hits.slot + first, size, 0U);
  }
}

void solve_by_common_part(const RayStream& rays, const HitStream& hits) {
  if (rays.shared.has_origin()) {
    read_solve_write<CommonPart::origin>(rays, hits);
  } else if (rays.shared.has_direction()) {
    read_solve_write<CommonPart::direction>(rays, hits);
  } else {
    read_solve_write<CommonPart::none>(rays, hits);
  }
}

}  // namespace

extern const OneSolve one_solve;
const OneSolve one_solve = solve_by_common_part;

}  // namespace boule::bench::BOULE_KERNEL_ISA
