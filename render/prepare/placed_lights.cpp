#include "render/prepare/placed_lights.h"

#include <cstddef>
#include <string>

#include "core/math/geometry.h"

namespace boule {
namespace {

/// What a camera measures by: its axes, and how far away it looks.
struct CameraFrame {
  Vec3d eye, right, up, backward;
  double distance;

  explicit CameraFrame(const CameraPose& pose)
      : eye(vec_cast<double>(pose.eye)),
        right(normalize(cross(view_direction(pose), vec_cast<double>(pose.up)))),
        up(cross(right, view_direction(pose))),
        backward(view_direction(pose) * -1.0),
        distance(length(vec_cast<double>(pose.look_at) - eye)) {}

  [[nodiscard]] Vec3f direction(const Vec3f& d) const { return vec_cast<float>(turned(d)); }
  [[nodiscard]] Vec3f point(const Vec3f& p) const {
    return vec_cast<float>(eye + turned(p) * distance);
  }
  [[nodiscard]] Vec3d turned(const Vec3f& v) const {
    return right * double{v.x} + up * double{v.y} + backward * double{v.z};
  }
};

void place(PointLight& light, const CameraFrame& frame) {
  light.position = frame.point(light.position);
}
void place(DirectionalLight& light, const CameraFrame& frame) {
  light.direction = frame.direction(light.direction);
}
void place(SphereLight& light, const CameraFrame& frame) {
  light.center = frame.point(light.center);
  light.radius = static_cast<float>(double{light.radius} * frame.distance);
}

}  // namespace

Status place_lights(std::vector<Light>& lights, const Camera& camera) {
  const CameraFrame frame(std::visit([](const auto& any) { return any.pose; }, camera));
  const auto place_one = [&frame](auto& light) {
    if (light.relative_to == LightFrame::scene) return;
    place(light, frame);
    light.relative_to = LightFrame::scene;
  };
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::visit(place_one, lights[i]);
    if (const auto bad = find_problem(lights[i])) {
      return Diagnostic::about("light[" + std::to_string(i) + "]." + bad->field,
                               "placed relative to the camera it " + bad->message);
    }
  }
  return {};
}

}  // namespace boule
