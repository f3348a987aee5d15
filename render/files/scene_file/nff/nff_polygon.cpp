#include "render/files/scene_file/nff/nff_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/geometry.h"

namespace boule {

Result<Plane> plane_through(const std::vector<Vec3f>& vertices) {
  // Relative to the first vertex: far from the origin no digits are lost.
  const Vec3d origin = vec_cast<double>(vertices[0]);
  const auto relative = [&](std::size_t i) { return vec_cast<double>(vertices[i]) - origin; };
  Vec3d sum;  // twice the area vector
  double extent = 0;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    extent = std::max(extent, length(relative(i)));
    if (i + 1 < vertices.size()) sum = sum + cross(relative(i), relative(i + 1));
  }
  constexpr double least_area = 1e-6, most_bend = 1e-3;
  if (!(length(sum) > least_area * extent * extent)) {
    return Diagnostic::of("the polygon has no area: its vertices are on one line");
  }
  const Vec3d normal = normalize(sum);
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    if (std::fabs(dot(relative(i), normal)) > most_bend * extent) {
      return Diagnostic::of("the polygon is not flat, so there is no plane for it");
    }
  }
  return Plane{vertices[0], vec_cast<float>(normal)};
}

}  // namespace boule
