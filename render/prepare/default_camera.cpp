#include "render/prepare/default_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/geometry.h"
#include "core/scene/capsule_ends.h"
#include "core/scene/instances.h"
#include "core/scene/principal_pose.h"
#include "render/prepare/extreme_spheres.h"
#include "render/prepare/outlying_spheres.h"
#include "render/prepare/shown_extremes.h"

namespace boule {
namespace {

/// The smallest distance from `point` that its float coordinates can resolve.
double smallest_distance(const Vec3d& point) { return length(point) * 0x1p-12; }

CameraPose pose_on_plane(const Plane& plane) {
  const Vec3d point = vec_cast<double>(plane.point);
  const Vec3d n = normalize(vec_cast<double>(plane.normal));
  // An axis that is far from parallel to the normal gives a direction across it.
  const Vec3d axis = std::fabs(n.z) < 0.8 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
  const Vec3d across = normalize(axis - n * dot(axis, n));
  const double distance = std::max(4.0, smallest_distance(point));
  return {vec_cast<float>(point + (n * 0.4 + across) * distance), plane.point, vec_cast<float>(n)};
}

Camera camera_without_spheres(const Scene& scene, int width, int height) {
  const CameraPose pose = scene.planes.empty() ? CameraPose{} : pose_on_plane(scene.planes.front());
  const FovAxis shorter = width <= height ? FovAxis::x : FovAxis::y;
  return PinholeCamera{pose, scene.fit.fov, scene.fit.fov_axis.value_or(shorter)};
}

/// What default_view() depends on.
std::vector<SphereMeasure> measures_of_view(const Scene& scene, const CameraFit& fit) {
  std::vector<SphereMeasure> measures;
  for (const Vec3d& axis : measured_axes(fit, scene.planes)) {
    for (const double weight : {0.0, 1.0}) {
      measures.push_back({axis, weight});
      measures.push_back({axis * -1.0, weight});
    }
  }
  return measures;
}

View view_of(const Scene& scene, const CameraFit& fit, const ParallelFor& parallel_for) {
  const ShownExtremes extremes(scene, parallel_for);
  return default_view(fit, extremes.runs(measures_of_view(scene, fit)), scene.planes, parallel_for);
}

/// The same as for a list of spheres, but by those only that the camera depends on.
Camera camera_of_packed(const Scene& scene, int width, int height) {
  const PackedSpheres& packed = *scene.packed;
  const auto extremes = [&](const std::vector<SphereMeasure>& measures) {
    std::vector<Sphere> spheres = extreme_spheres(packed, measures);
    visit_end_spheres(
        scene, [&](SphereRun ends) { spheres.insert(spheres.end(), ends.begin(), ends.end()); });
    return spheres;
  };
  const View view =
      default_view(scene.fit, extremes(measures_of_view(scene, scene.fit)), scene.planes);
  CameraFitter fitter(scene.fit, view, width, height);
  fitter.add(extremes(fitter.measures()));
  return fitter.camera();
}

/// A box of nothing, to be widened.
SphereBounds empty_box() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {{inf, inf, inf}, {-inf, -inf, -inf}};
}

/// Widens a box by that of a sphere.
void widen(SphereBounds& box, const Sphere& s) {
  const Vec3d c = vec_cast<double>(s.center);
  const auto r = static_cast<double>(s.radius);
  auto& [low, high] = box;
  low = {std::min(low.x, c.x - r), std::min(low.y, c.y - r), std::min(low.z, c.z - r)};
  high = {std::max(high.x, c.x + r), std::max(high.y, c.y + r), std::max(high.z, c.z + r)};
}

}  // namespace

SphereBounds bounds_of(const Scene& scene) {
  const bool packed = scene.packed && scene.packed->count > 0;
  SphereBounds box = packed ? SphereBounds{scene.packed->low, scene.packed->high} : empty_box();
  const auto add = [&box](SphereRun spheres) {
    for (const Sphere& s : spheres) widen(box, s);
  };
  if (packed) {
    visit_end_spheres(scene, add);
    return box;
  }
  std::vector<SphereMeasure> measures;
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    measures.push_back({axis, 1});
    measures.push_back({axis * -1.0, 1});
  }
  ShownExtremes(scene, serial_for).runs(measures)(add);
  return box;
}

SphereBounds bounds_without_outliers(const Scene& scene) {
  const auto median = median_sphere(scene);
  if (!median) return bounds_of(scene);
  const NearOthers is_near(scene, *median);
  SphereBounds box = empty_box();
  for (const Sphere& s : scene.spheres) {
    if (is_near(s)) widen(box, s);
  }
  visit_end_spheres(scene, [&box](SphereRun ends) {
    for (const Sphere& s : ends) widen(box, s);
  });
  return box;
}

View view_of(const Scene& scene, const ParallelFor& parallel_for) {
  return view_of(scene, settled_fit(scene, parallel_for), parallel_for);
}

void add_spheres(const Scene& scene, CameraFitter& fitter, const ParallelFor& parallel_for) {
  const ShownExtremes extremes(scene, parallel_for);
  extremes.runs(fitter.measures())([&](SphereRun run) { fitter.add(run, parallel_for); });
}

namespace {

/// The camera that frames all spheres and capsules.
Camera camera_around(const Scene& scene, int width, int height, const ParallelFor& parallel_for) {
  const CameraFit fit = settled_fit(scene, parallel_for);
  CameraFitter fitter(fit, view_of(scene, fit, parallel_for), width, height);
  add_spheres(scene, fitter, parallel_for);
  return fitter.camera();
}

}  // namespace

DefaultCamera choose_camera(const Scene& scene, int width, int height,
                            const ParallelFor& parallel_for) {
  if (scene.packed && scene.packed->count > 0) return {camera_of_packed(scene, width, height)};
  if (count_primitives(scene).finite() == 0) return {camera_without_spheres(scene, width, height)};
  const Camera all = camera_around(scene, width, height, parallel_for);
  if (!may_be_specks(scene, all, width, height)) return {all};
  const auto median = median_sphere(scene);
  if (!median || !(pixels_across(*median, all, width, height) < 1)) return {all};
  const auto rest = without_outliers(scene, *median);
  if (!rest) return {all};
  const Camera near = camera_around(*rest, width, height, parallel_for);
  if (!is_better_without(*median, all, near, width, height)) return {all};
  return {near, true};
}

}  // namespace boule
