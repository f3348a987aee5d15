#include "bench/scenes/balls.h"

#include <array>
#include <cmath>

#include "core/math/geometry.h"

namespace boule::bench {
namespace {

using Directions = std::array<Vec3d, 9>;

/// v turned about the unit `axis` by the angle of this cosine and sine, counter-clockwise seen from
/// the axis' tip (Rodrigues).
Vec3d turn(const Vec3d& v, const Vec3d& axis, double cosine, double sine) {
  return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1 - cosine));
}

/// The directions of the nine children of a sphere that grows along +z.
Directions child_directions() {
  const double h = std::sqrt(0.5);
  const Vec3d trio[] = {{h, h, 0}, {h, 0, -h}, {0, h, -h}};
  const Vec3d tilt_axis = {h, -h, 0};
  const double third_turn[][2] = {{1, 0}, {-0.5, std::sqrt(0.75)}, {-0.5, -std::sqrt(0.75)}};
  Directions directions;
  std::size_t next = 0;
  for (const auto& [cosine, sine] : third_turn) {
    for (const Vec3d& v : trio) {
      const Vec3d tilted = turn(v, tilt_axis, std::sqrt(1.0 / 3), std::sqrt(2.0 / 3));
      directions[next++] = turn(tilted, {0, 0, 1}, cosine, sine);
    }
  }
  return directions;
}

/// v under the rotation that takes +z to `up`; if `up` is -z, that is half a turn about y.
Vec3d turn_with_z(const Vec3d& v, const Vec3d& up) {
  if (up.z >= 1) return v;
  if (up.z <= -1 + 1e-12) return {-v.x, v.y, -v.z};
  const Vec3d axis = cross(Vec3d{0, 0, 1}, up);
  const double sine = length(axis);
  return turn(v, axis * (1 / sine), up.z, sine);
}

void grow(const Vec3d& center, double radius, const Vec3d& up, int depth,
          const Directions& directions, std::vector<Sphere>& spheres) {
  spheres.push_back({vec_cast<float>(center), static_cast<float>(radius)});
  if (depth == 0) return;
  for (const Vec3d& direction : directions) {
    const Vec3d child_up = normalize(turn_with_z(direction, up));
    grow(center + child_up * (radius * 4 / 3), radius / 3, child_up, depth - 1, directions,
         spheres);
  }
}

}  // namespace

std::vector<Sphere> balls(int depth) {
  std::vector<Sphere> spheres;
  grow({0, 0, 0}, 0.5, {0, 0, 1}, depth, child_directions(), spheres);
  return spheres;
}

}  // namespace boule::bench
