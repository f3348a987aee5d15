#include "render/prepare/default_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule {
namespace {

constexpr double default_fov = 45;

/// Empty space around the objects, as a factor on the distance.
constexpr double margin = 1.05;

/// A sphere around all spheres: the middle of their bounding box and the radius that holds them.
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

/// A step that float coordinates near `point` can still resolve.
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
  // The axis least like the normal gives a direction across it.
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

/// Whether a background counts as light. Of a constant one and of a picture only path tracing finds
/// any.
bool is_light(const Background& background, Method method) {
  if (const auto* gradient = std::get_if<GradientBackground>(&background)) {
    return !is_black(gradient->bottom) || !is_black(gradient->top);
  }
  if (method == Method::whitted) return false;
  if (const auto* constant = std::get_if<ConstantBackground>(&background)) {
    return !is_black(constant->color);
  }
  const auto& pixels = std::get<EnvironmentBackground>(background).pixels;
  return !std::all_of(pixels.begin(), pixels.end(), is_black);
}

/// Whether any object gives light. Most scenes have no material that does.
bool has_emitter(const Scene& scene) {
  std::vector<bool> emits;
  for (const NamedMaterial& named : scene.materials) {
    const auto* emissive = std::get_if<Emissive>(&named.material);
    emits.push_back(emissive != nullptr && !is_black(emissive->radiance));
  }
  if (std::find(emits.begin(), emits.end(), true) == emits.end()) return false;
  const auto gives = [&emits](const auto& object) -> bool { return emits[object.material]; };
  return std::any_of(scene.spheres.begin(), scene.spheres.end(), gives) ||
         std::any_of(scene.planes.begin(), scene.planes.end(), gives);
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

bool lacks_light(const Scene& scene, Method method) {
  return scene.lights.empty() && !is_light(scene.background, method) && !has_emitter(scene);
}

const char* light_note(const Scene& scene, Method method) {
  const bool unused =
      method == Method::whitted && std::holds_alternative<EnvironmentBackground>(scene.background);
  return unused ? "no light in the scene, and by method whitted its environment is none: one white "
                  "point light at the eye"
                : "no light in the scene: one white point light at the eye";
}

PointLight light_at_eye(const Camera& camera) {
  PointLight light;
  light.position = std::visit([](const auto& any) { return any.pose.eye; }, camera);
  return light;
}

}  // namespace boule
