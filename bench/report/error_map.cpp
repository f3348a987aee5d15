#include "bench/report/error_map.h"

#include <cmath>

#include "core/math/geometry.h"
#include "tests/support/case_random.h"

namespace boule::bench {
namespace {

using test::CaseRandom;

constexpr std::uint64_t seed = 61;

/// Rays from near the world's origin, a unit sphere each at that distance in any direction.
test::HardCase aim(int distance, int grazing, std::size_t rays) {
  test::HardCase pairs;
  const auto stream =
      static_cast<std::uint64_t>(distance) * 100 + static_cast<std::uint64_t>(grazing);
  CaseRandom random(seed, stream);
  for (std::size_t i = 0; i < rays; ++i) {
    const Vec3d org = vec_cast<double>(vec_cast<float>(random.direction()));
    const double away = std::pow(10, distance / 2.0);
    const Sphere sphere{vec_cast<float>(org + random.direction() * away), 1, 0};
    const Vec3d view = vec_cast<double>(sphere.center) - org;
    const double impact = 1 + (i % 2 == 0 ? -1 : 1) * std::ldexp(1.0, -grazing);
    const double sine = impact / length(view);
    const Vec3d towards = normalize(view), side = random.perpendicular(towards);
    const Vec3d dir = towards * std::sqrt(1 - sine * sine) + side * sine;
    pairs.spheres.push_back(sphere);
    pairs.rays.push_back({org, vec_cast<float>(dir)});
  }
  return pairs;
}

}  // namespace

ErrorMap map_errors(std::size_t rays, Isa isa) {
  ErrorMap map;
  for (int grazing = ErrorMap::least; grazing <= ErrorMap::most; grazing += 2) {
    for (int distance = ErrorMap::nearest; distance <= ErrorMap::farthest; ++distance) {
      for (auto& [contender, figures] : errors_of(aim(distance, grazing, rays), isa))
        map.cells.push_back({contender, distance, grazing, figures});
    }
  }
  return map;
}

}  // namespace boule::bench
