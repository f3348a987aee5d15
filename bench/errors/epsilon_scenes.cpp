#include "bench/errors/epsilon_scenes.h"

#include <cmath>
#include <utility>

#include "core/math/elementary.h"
#include "core/math/geometry.h"

namespace boule::bench {
namespace {

EpsilonScene make(std::string experiment, double x, const PinholeCamera& camera,
                  const Vec3d& light) {
  EpsilonScene made{std::move(experiment), x, {}};
  made.scene.image = {320, 240, 1};
  made.scene.camera = camera;
  made.scene.lights = {PointLight{vec_cast<float>(light)}};
  return made;
}

PinholeCamera look(const Vec3d& eye, const Vec3d& look_at, double fov) {
  return {{vec_cast<float>(eye), vec_cast<float>(look_at), {0, 1, 0}}, static_cast<float>(fov)};
}

Sphere ball(const Vec3d& center, double radius) {
  return {vec_cast<float>(center), static_cast<float>(radius), 0};
}

/// A ground sphere whose top is the world's origin. `up` is along no axis: along one, many sums
/// would be exact by luck.
struct Ground {
  Vec3d up = normalize({1, 4, 2}), right = normalize(cross(up, {0, 0, 1})), back = cross(right, up);
  Sphere sphere;

  explicit Ground(double radius) : sphere(ball(up * -radius, radius)) {}

  /// The point at this height above the ground sphere, this far to the right and to the back.
  [[nodiscard]] Vec3d above(double height, double x, double z) const {
    const double from_center = double{sphere.radius} + height;
    const double rise = std::sqrt(from_center * from_center - x * x - z * z);
    return vec_cast<double>(sphere.center) + right * x + back * z + up * rise;
  }
};

}  // namespace

EpsilonScene scene_of_scale(double factor) {
  const auto camera = look(Vec3d{0.25, 4, 8.5} * factor, Vec3d{0, 0.75, 0} * factor, 46);
  EpsilonScene made = make("scale", factor, camera, Vec3d{4, 6, 3} * factor);
  const std::pair<Vec3d, double> balls[] = {
      {{0, 1, 0}, 1},         {{-2.5, 1, 1}, 1},       {{2.25, 0.75, 1.5}, 0.75},
      {{-2.5, 2, -3.5}, 2},   {{0.75, 2, 0}, 0.25},    {{0.75, 0.25, 2.75}, 0.25},
      {{-0.75, 0.5, 2}, 0.5}, {{2.75, 1.25, -2}, 1.25}};
  for (const auto& [center, radius] : balls)
    made.scene.spheres.push_back(ball(center * factor, radius * factor));
  // The floor is along the axes: its points may be exact by luck. The wall is oblique.
  made.scene.planes = {{{0, 0, 0}, {0, 1, 0}, 0},
                       {vec_cast<float>(Vec3d{0, 0, -7} * factor), {2, 1, 8}, 0}};
  return made;
}

EpsilonScene scene_at_distance(double distance) {
  const Vec3d way = normalize({1, 1.5, 4});
  constexpr double degrees_per_radian = 180 / elementary::pi;
  const double fov = 2 * degrees_per_radian * std::atan(1.75 / distance);
  EpsilonScene made = make("distance", distance, look(way * distance, {}, fov), {3, 4.5, 1});
  made.scene.spheres = {ball({0, 0, 0}, 1), ball({0.75, 1, 0}, 0.25)};  // 5/4 apart: they touch
  return made;
}

EpsilonScene scene_on_ground(double radius) {
  const Ground ground(radius);
  PinholeCamera camera = look(ground.above(2, 0.3, 8.5), ground.above(0.6, 0, 0), 50);
  camera.pose.up = vec_cast<float>(ground.up);
  EpsilonScene made = make("ground", radius, camera, ground.above(4, 5, 2.5));
  made.scene.spheres = {ground.sphere};
  const std::pair<double, double> places[] = {
      {0, 0}, {-2.25, 0.5}, {2.5, -0.5}, {-1.25, -5}, {1.5, -6}};
  for (const auto& [x, z] : places) made.scene.spheres.push_back(ball(ground.above(1, x, z), 1));
  return made;
}

std::vector<EpsilonScene> epsilon_scenes() {
  std::vector<EpsilonScene> scenes;
  for (int k = -4; k <= 6; ++k) scenes.push_back(scene_of_scale(elementary::pow(10, k)));
  for (int k = 1; k <= 12; ++k) scenes.push_back(scene_at_distance(elementary::pow(10, 0.5 * k)));
  for (int k = 1; k <= 6; ++k) scenes.push_back(scene_on_ground(elementary::pow(10, k)));
  return scenes;
}

}  // namespace boule::bench
