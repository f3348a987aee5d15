#include "render/prepare/default_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/math/geometry.h"
#include "core/math/similarity.h"
#include "render/prepare/fold_spheres.h"

namespace boule {
namespace {

Vec3d unit(const Vec3f& v) { return normalize(vec_cast<double>(v)); }

/// The axis that a plane's normal lies along, within about 18 degrees; y if it lies along none or
/// along x, as that of a wall does.
Vec3d up_of(const std::vector<Plane>& planes) {
  constexpr double steep = 0.95;
  if (planes.empty()) return {0, 1, 0};
  const Vec3d normal = unit(planes.front().normal);
  if (std::fabs(normal.z) > steep) return {0, 0, normal.z > 0 ? 1.0 : -1.0};
  return {0, normal.y < -steep ? -1.0 : 1.0, 0};
}

/// The directions by which a place is described from its front: right x up = front.
struct Compass {
  Vec3d right, up, front;
};

Compass compass_of(const Vec3d& up) {
  const Vec3d aside = std::fabs(up.x) < 0.9 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d right = normalize(aside - up * dot(aside, up));
  return {right, up, cross(right, up)};
}

/// How long the spheres are together along an axis, and how far their centres are apart.
struct AxisExtent {
  double spheres = 0, centers = 0;
};

/// Where spheres lie along an axis.
struct AxisRange {
  static constexpr double inf = std::numeric_limits<double>::infinity();
  double low = inf, high = -inf, lowest_center = inf, highest_center = -inf;

  void add(const Vec3d& center, double radius, const Vec3d& axis) {
    const double along = dot(center, axis);
    add({along - radius, along + radius, along, along});
  }
  void add(const AxisRange& range) {
    low = std::min(low, range.low);
    high = std::max(high, range.high);
    lowest_center = std::min(lowest_center, range.lowest_center);
    highest_center = std::max(highest_center, range.highest_center);
  }
  [[nodiscard]] AxisExtent extent() const {
    return {std::max(high - low, 0.0), std::max(highest_center - lowest_center, 0.0)};
  }
};

using Ranges = std::array<AxisRange, 3>;

/// Along the three directions of a compass.
Ranges ranges_of(const Compass& compass, const SphereRuns& spheres,
                 const ParallelFor& parallel_for) {
  const std::array<Vec3d, 3> axes{compass.right, compass.up, compass.front};
  const auto add = [&](Ranges& ranges, const Sphere& sphere) {
    const Vec3d center = vec_cast<double>(sphere.center);
    for (std::size_t k = 0; k < 3; ++k)
      ranges[k].add(center, static_cast<double>(sphere.radius), axes[k]);
  };
  const auto join = [](Ranges& ranges, const Ranges& others) {
    for (std::size_t k = 0; k < 3; ++k) ranges[k].add(others[k]);
  };
  Ranges all;
  spheres([&](SphereRun run) { all = fold_spheres(run, parallel_for, all, add, join); });
  return all;
}

/// True if spheres are a sheet, one sphere thick, as simulations in two dimensions are.
bool is_sheet(const AxisExtent& thick, const AxisExtent& a, const AxisExtent& b) {
  constexpr double centers = 1e-3, thin = 0.25;
  return thick.centers <= centers * thick.spheres &&
         thick.spheres <= thin * std::min(a.spheres, b.spheres);
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : 1; }

/// The direction from the spheres to the camera; a sheet is seen face on, unless it lies on a
/// floor.
Vec3d way_to_camera(Compass compass, const Ranges& ranges, bool has_floor) {
  // Tangents. They are those of 32 and 20 degrees, and of 50 for what is flat.
  constexpr double aside = 0.625, above = 0.371, above_flat = 1.19;
  const AxisExtent x = ranges[0].extent(), y = ranges[1].extent(), z = ranges[2].extent();
  if (is_sheet(y, x, z) && !has_floor) return compass.up;
  if (is_sheet(z, x, y)) return compass.front;
  if (is_sheet(x, y, z)) return compass.right;
  double wide = x.spheres, deep = z.spheres;
  const double high = y.spheres;
  // Of what is about as deep as wide, the front is the front.
  constexpr double clearly = 1.1;
  if (deep > wide * clearly) {
    std::swap(wide, deep);
    compass = {compass.front * -1.0, compass.up, compass.right};
  }
  const double flat = std::max(0.0, 1 - 2 * ratio(high, deep));
  const double across = aside * std::min(1.0, ratio(deep, wide));
  const double rise = (above + (above_flat - above) * flat) * std::sqrt(1 + across * across);
  return normalize(compass.front + compass.right * across + compass.up * rise);
}

/// True for directions so close to each other, or to each other's opposite, that one is not upward
/// in a picture in which the other is looked along.
bool are_parallel(const Vec3d& a, const Vec3d& b) { return length(cross(a, b)) < 1e-3; }

/// The picture turns one way when the camera's up turns the other way.
View rolled(const View& view, double degrees) {
  const Vec3d right = normalize(cross(view.direction, view.up));
  const Vec3d up = cross(right, view.direction);
  const auto [cosine, sine] = turn_of(degrees);
  return {view.direction, up * cosine + right * sine};
}

}  // namespace

View default_view(const CameraFit& fit, const std::vector<Sphere>& spheres,
                  const std::vector<Plane>& planes, const ParallelFor& parallel_for) {
  const SphereRuns one_run = [&spheres](const std::function<void(SphereRun)>& function) {
    function(spheres);
  };
  return default_view(fit, one_run, planes, parallel_for);
}

View default_view(const CameraFit& fit, const SphereRuns& spheres, const std::vector<Plane>& planes,
                  const ParallelFor& parallel_for) {
  View view;
  view.up = fit.up ? unit(*fit.up) : up_of(planes);
  if (fit.direction) {
    view.direction = unit(*fit.direction);
  } else {
    const Compass compass = compass_of(view.up);
    const Ranges ranges = ranges_of(compass, spheres, parallel_for);
    view.direction = way_to_camera(compass, ranges, !planes.empty()) * -1.0;
  }
  if (!(fit.up && fit.direction) && are_parallel(view.up, view.direction)) {
    // Seen from above or below, what is behind is upward, as on a map.
    view.up = compass_of(view.up).front * -1.0;
  }
  return fit.roll == 0 ? view : rolled(view, static_cast<double>(fit.roll));
}

std::array<Vec3d, 3> measured_axes(const CameraFit& fit, const std::vector<Plane>& planes) {
  const Compass compass = compass_of(fit.up ? unit(*fit.up) : up_of(planes));
  return {compass.right, compass.up, compass.front};
}

}  // namespace boule
