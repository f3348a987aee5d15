#include "render/apps/job/turntable.h"

#include <utility>
#include <variant>
#include <vector>

#include "core/math/geometry.h"
#include "core/math/similarity.h"
#include "core/scene/capsule_ends.h"
#include "core/scene/instances.h"
#include "core/scene/principal_pose.h"
#include "render/prepare/camera_fitter.h"
#include "render/prepare/default_camera.h"

namespace boule {
namespace {

const CameraPose& pose_of(const Camera& camera) {
  return std::visit([](const auto& kind) -> const CameraPose& { return kind.pose; }, camera);
}

/// Where spheres that turn around an axis come nearest to the sides that a camera is fitted by.
class TurningSpheres {
 public:
  TurningSpheres(const Vec3d& point, const Vec3d& axis) : point_(point), axis_(axis) {}

  /// The spheres where they have the least of a measure.
  [[nodiscard]] std::vector<Sphere> least(const std::vector<Sphere>& spheres,
                                          const SphereMeasure& measure) const {
    const Vec3d across = measure.direction - axis_ * dot(measure.direction, axis_);
    const double share = length(across);
    std::vector<Sphere> turned = spheres;
    if (!(share > 0)) return turned;
    for (Sphere& sphere : turned) {
      const Vec3d from = vec_cast<double>(sphere.center) - point_;
      const double height = dot(from, axis_);
      const double radius = length(from - axis_ * height);
      sphere.center = vec_cast<float>(point_ + axis_ * height - across * (radius / share));
    }
    return turned;
  }

 private:
  Vec3d point_, axis_;
};

/// All spheres, and those around the ends of capsules.
std::vector<Sphere> shown_spheres(const Scene& scene) {
  std::vector<Sphere> spheres = scene.spheres;
  visit_shown(scene, [&](const Sphere& sphere) { spheres.push_back(sphere); });
  visit_end_spheres(
      scene, [&](SphereRun ends) { spheres.insert(spheres.end(), ends.begin(), ends.end()); });
  return spheres;
}

Vec3d turned(const Vec3d& v, const Vec3d& axis, double degrees) {
  const auto [cosine, sine] = turn_of(degrees);
  return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1 - cosine));
}

}  // namespace

Result<Turntable> Turntable::of(const Scene& scene, const Size& size,
                                const ParallelFor& parallel_for) {
  if (scene.camera) {
    const CameraPose& pose = pose_of(*scene.camera);
    return Turntable(*scene.camera, vec_cast<double>(pose.look_at),
                     normalize(vec_cast<double>(pose.up)));
  }
  if (scene.packed)
    return Diagnostic::about("--turn", "packed spheres need a camera, such as by --camera");
  Scene settled;
  settled.spheres = shown_spheres(scene);
  if (settled.spheres.empty())
    return Diagnostic::about("--turn", "the scene has no spheres or capsules to turn");
  settled.planes = scene.planes;
  settled.fit = settled_fit(scene, parallel_for);
  const View view = view_of(settled, parallel_for);
  CameraFitter fitter(settled.fit, view, size.width, size.height);
  settled.fit.roll = 0;  // the picture is rolled, not what turns
  const Vec3d axis = view_of(settled, parallel_for).up;
  const SphereBounds box = bounds_of(settled);
  const Vec3d middle = box.low * 0.5 + box.high * 0.5;
  const TurningSpheres turning(middle, axis);
  for (const SphereMeasure& measure : fitter.measures())
    fitter.add(turning.least(settled.spheres, measure), parallel_for);
  Camera camera = fitter.camera();
  if (const auto problem = find_problem(camera)) {
    return Diagnostic::about("--turn", "the camera's " + problem->field + " " + problem->message);
  }
  return Turntable(std::move(camera), middle, axis);
}

Camera Turntable::at(double degrees) const {
  Camera camera = camera_;
  if (degrees == 0) return camera;
  std::visit(
      [&](auto& kind) {
        CameraPose& pose = kind.pose;
        const auto move = [&](const Vec3f& point) {
          const Vec3d from = vec_cast<double>(point) - point_;
          return vec_cast<float>(point_ + turned(from, axis_, -degrees));
        };
        pose.eye = move(pose.eye);
        pose.look_at = move(pose.look_at);
        pose.up = vec_cast<float>(turned(vec_cast<double>(pose.up), axis_, -degrees));
      },
      camera);
  return camera;
}

}  // namespace boule
