#include "render/renderer/ray_columns.h"

#include <limits>

namespace boule {
namespace {

/// The nearest float of a finite number; infinity for infinity and for numbers that are too large.
float to_float(double x) {
  constexpr double too_large = 0x1.ffffffp127;  // halfway from the largest float to 2^128
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (x >= too_large) return infinity;
  return x <= -too_large ? -infinity : static_cast<float>(x);
}

Vec3d vector_at(const RayNumbers& column, std::size_t ray) {
  return {column.at(ray, 0), column.at(ray, 1), column.at(ray, 2)};
}

}  // namespace

Ray RayColumns::at(std::size_t k) const {
  const Vec3d towards = vector_at(dir, k);
  Ray ray{vector_at(org, k) - zero,
          {to_float(towards.x), to_float(towards.y), to_float(towards.z)}};
  ray.tmin = tmin.at(k);
  ray.tmax = tmax.at(k);
  if (source.first != nullptr) ray.source = static_cast<std::int32_t>(source.at(k));
  ray.inside = inside.first != nullptr && inside.at(k) != 0;
  return ray;
}

}  // namespace boule
