#pragma once

#include <optional>
#include <vector>

#include "core/scene/camera_pose.h"
#include "core/scene/primitive.h"

namespace boule {

/// One surface of a lens, or a stop, as prescriptions list them, from the scene to the film.
struct LensSurface {
  float radius = 0;  ///< of curvature, > 0 if the centre is on the film's side; 0: flat, a stop
  float thickness =
      0;               ///< along the axis to the next surface, >= 0; of the last one: of no meaning
  float index = 1;     ///< of refraction up to the next surface, > 0
  float aperture = 0;  ///< diameter, > 0
};

/// A lens of real elements before a film (Kolb, Mitchell, Hanrahan, "A realistic camera model for
/// computer graphics", SIGGRAPH 1995). The eye is the middle of its first surface; the film moves
/// so that what is at the distance `focus` from there along L is sharp.
struct LensCamera {
  CameraPose pose;
  std::vector<LensSurface> surfaces;  ///< not empty, in any unit of length
  float film_width = 36;              ///< in that unit, > 0
  float scale = 0.001f;               ///< world units per such unit, > 0
  std::optional<float> focus{};       ///< in world units, > 0; none: the distance of look_at
};

/// The focal length of a lens for rays close to its axis, in its own unit.
double focal_length(const std::vector<LensSurface>& surfaces);

/// How far behind the last surface the rays close to the axis meet again that come from a point at
/// `distance` before the first one; inf: at infinity. Not above 0: nowhere behind it.
double image_distance(const std::vector<LensSurface>& surfaces, double distance);

}  // namespace boule
