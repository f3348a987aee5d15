#pragma once

#include <cmath>
#include <optional>

#include "core/math/elementary.h"
#include "core/math/geometry.h"
#include "core/optics/camera_view.h"
#include "core/scene/primitive.h"

namespace boule {

/// A sphere in the picture, in pixels of the frame.
struct Disc {
  double x, y;
  double radius;  ///< the least
  double reach;   ///< the greatest
};

/// Where a camera shows spheres: of a thin lens what is in focus, and without the map of
/// distortions. Precondition: the camera's kind is not `lens`.
class Projection {
 public:
  Projection(const CameraView& camera, int width)
      : camera_(camera), pixels_(width / (2 * length(camera.right))) {}

  /// Whether straight lines are straight in the picture.
  [[nodiscard]] bool keeps_lines() const { return camera_.kind != CameraKind::fisheye; }

  /// None: the camera does not see its middle.
  [[nodiscard]] std::optional<Disc> of(const Sphere& sphere) const {
    const Vec3d way = vec_cast<double>(sphere.center) - camera_.eye;
    const double depth = dot(way, camera_.forward), radius = std::fabs(double{sphere.radius});
    const Vec3d across = way - camera_.forward * depth;
    switch (camera_.kind) {
      case CameraKind::orthographic:
        return disc(across, radius, 1);
      case CameraKind::fisheye: {
        const double side = length(across), distance = length(way);
        if (!(distance > 0)) return std::nullopt;
        const double angle = elementary::atan2(side, depth);
        const double ratio = side > 0 ? angle / side : 0;
        // A circle of this angle around the axis is longer on the film than on the sphere.
        return disc(across * ratio, radius / distance, side > 0 ? distance * ratio : 1);
      }
      default:
        if (!(depth > 0)) return std::nullopt;
        return disc(across * (1 / depth), radius / depth, length(way) / depth);
    }
  }

 private:
  /// `point` on the film; `radius` there, and `stretch` times that in some direction.
  [[nodiscard]] Disc disc(const Vec3d& point, double radius, double stretch) const {
    const auto raster = [](const RasterToFilm& map, double film) {
      return (film * map.extent - map.offset) / map.scale;
    };
    const auto along = [&](const Vec3d& half) { return dot(point, half) / dot(half, half); };
    return {raster(camera_.film_x, along(camera_.right)), raster(camera_.film_y, along(camera_.up)),
            radius * pixels_, radius * stretch * pixels_};
  }

  const CameraView& camera_;
  double pixels_;  ///< of a length on the film
};

}  // namespace boule
