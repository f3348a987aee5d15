#pragma once

#include <optional>

#include "core/math/vec.h"
#include "core/optics/camera_view.h"
#include "core/scene/scene.h"
#include "render/prepare/sphere_bounds.h"

namespace boule {

/// Fog between the camera and what it sees: a share of the backdrop in place of it, which grows
/// with the depth from 0 at `from` to `strength` at `to` and beyond. Depths are along the camera's
/// view; before a fisheye they are distances.
struct Fog {
  float strength = 0;  ///< 0 .. 1; 0: none
  double from = 0, to = 0;

  /// The share of the backdrop at a depth.
  [[nodiscard]] float share(double depth) const;
};

/// The depth of a point.
double depth_of(const CameraView& camera, const Vec3d& point);

/// The fog that a picture asks for. What it leaves open are the depths of the nearest and of the
/// farthest point of the ellipsoid in the box, 0 or more: they change evenly as the camera turns.
/// Without a box they are 0.
Fog fog_of(const ImageSettings& image, const std::optional<SphereBounds>& box,
           const CameraView& camera);

}  // namespace boule
