#include "render/prepare/default_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

constexpr double default_fov = 45;

/// The distance to the objects is multiplied by this, to leave empty space around them.
constexpr double margin = 1.05;

/// A sphere around all spheres: its center is the middle of their bounding box.
struct Enclosure {
  Vec3d center;
  double radius = 0;
};

Enclosure enclose(const std::vector<Sphere>& spheres) {
  const auto [low, high] = bounds_of(spheres);
  Enclosure enclosure{(low + high) * 0.5};
  for (const Sphere& s : spheres) {
    const double away = length(vec_cast<double>(s.center) - enclosure.center);
    enclosure.radius = std::max(enclosure.radius, away + static_cast<double>(s.radius));
  }
  return enclosure;
}

/// The smallest distance from `point` that its float coordinates can resolve.
double smallest_distance(const Vec3d& point) { return length(point) * 0x1p-12; }

CameraPose pose_on_spheres(const std::vector<Sphere>& spheres) {
  const Enclosure enclosure = enclose(spheres);
  const double tangent = elementary::tan_acute(default_fov * (elementary::pi / 360));
  const double sine = tangent / std::sqrt(1 + tangent * tangent);
  const double distance =
      std::max(enclosure.radius / sine * margin, smallest_distance(enclosure.center));
  const Vec3d from = normalize(Vec3d{1, 0.7, 1.6});
  return {vec_cast<float>(enclosure.center + from * distance),
          vec_cast<float>(enclosure.center),
          {0, 1, 0}};
}

CameraPose pose_on_plane(const Plane& plane) {
  const Vec3d point = vec_cast<double>(plane.point);
  const Vec3d n = normalize(vec_cast<double>(plane.normal));
  // An axis that is far from parallel to the normal gives a direction across it.
  const Vec3d axis = std::fabs(n.z) < 0.8 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  const Vec3d across = normalize(axis - n * dot(axis, n));
  const double distance = std::max(4.0, smallest_distance(point));
  return {vec_cast<float>(point + (n * 0.4 + across) * distance), plane.point, vec_cast<float>(n)};
}

CameraPose default_pose(const Scene& scene) {
  if (!scene.spheres.empty()) return pose_on_spheres(scene.spheres);
  if (!scene.planes.empty()) return pose_on_plane(scene.planes.front());
  return {};
}

}  // namespace

SphereBounds bounds_of(const std::vector<Sphere>& spheres) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3d low{inf, inf, inf}, high{-inf, -inf, -inf};
  for (const Sphere& s : spheres) {
    const Vec3d c = vec_cast<double>(s.center);
    const auto r = static_cast<double>(s.radius);
    low = {std::min(low.x, c.x - r), std::min(low.y, c.y - r), std::min(low.z, c.z - r)};
    high = {std::max(high.x, c.x + r), std::max(high.y, c.y + r), std::max(high.z, c.z + r)};
  }
  return {low, high};
}

Camera default_camera(const Scene& scene, int width, int height) {
  // The shorter side spans the field of view, so that the objects fit into both.
  return PinholeCamera{default_pose(scene), static_cast<float>(default_fov),
                       width <= height ? FovAxis::x : FovAxis::y};
}

}  // namespace boule
