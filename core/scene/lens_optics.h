#pragma once

#include <span>
#include <vector>

#include "core/math/vec.h"
#include "core/scene/lens.h"

namespace boule {

/// One surface as rays from the film meet it, in the lens' space: the axis is z, from the middle of
/// the first surface to the film.
struct LensElement {
  double radius;     ///< as LensSurface::radius
  double place;      ///< z of the sphere's centre, or of the flat
  double aperture2;  ///< half the diameter, squared
  double eta;        ///< index on the film's side over index on the scene's
};

/// The part of the plane through the rear vertex that a film point can see the scene through, as a
/// box: x from the axis towards the film point, y across, from -y to y. Empty where x0 = x1.
struct PupilBox {
  double x0, x1, y;
};

/// The boxes of a ring of the film: of its inner and its outer points, linear between them. They
/// hold the exit pupils of all its points.
struct PupilRing {
  PupilBox inner, outer;
};

/// A lens focused and ready to be traced. In the film's middle the box' middle is on the axis.
struct LensOptics {
  std::vector<LensElement> elements;  ///< from the film to the scene
  double rear;                        ///< z of the last surface's middle
  double film;                        ///< z of the film
  double half_width, half_height;     ///< of the film
  double scale;                       ///< world units per unit of the lens
  std::vector<PupilRing> pupil;       ///< rings of equal width, from the middle of the film
  double rings_per_length;
  /// 1 / integral of cos^4 over the exit pupil in the middle of the film: weights are in units of
  /// what arrives there.
  double exposure;
};

/// A valid camera's lens (find_problem()), focused, its exit pupil found, for a picture of these
/// pixels, 1 or more, in so many rings, 1 or more. Of other lenses and sizes: numbers that may be
/// NaN, rays that are stopped. Throws std::bad_alloc.
LensOptics make_optics(const LensCamera& camera, int width, int height, int rings = 64);

/// The light that the middle of such a camera's film gathers: light_in_the_middle(). 0 for a camera
/// without surfaces. Throws std::bad_alloc.
double gathered_light(const LensCamera& camera);

/// Sends a ray of unit direction from the film through the elements; false if it is stopped: by a
/// rim, beside a sphere, by total reflection, or because a number is NaN.
bool trace_lens(std::span<const LensElement> elements, Vec3d& org, Vec3d& dir);

}  // namespace boule
