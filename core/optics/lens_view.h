#pragma once

namespace boule {

/// One surface of a lens for rays from the film, in the lens' space: the axis is z, from the middle
/// of the first surface to the film.
struct LensElement {
  double radius;     ///< as LensSurface::radius
  double z;          ///< of the sphere's centre, or of the flat surface
  double aperture2;  ///< half the diameter, squared
  double eta;        ///< index of refraction on the film's side over that on the scene's
};

/// The part of the plane through the rear vertex through which a film point can see the scene, as a
/// box: x from the axis towards the film point, y across, from -y to y. Empty if x0 = x1.
struct PupilBox {
  double x0, x1, y;
};

/// The boxes of a ring of the film: for its inner and its outer points, linear in between. They
/// hold the exit pupils of all its points.
struct PupilRing {
  PupilBox inner, outer;
};

/// A lens, focused and ready to be traced: a view of the numbers of LensOptics. In the middle of
/// the film, the middle of the box is on the axis.
struct LensView {
  const LensElement* elements;  ///< from the film to the scene
  int element_count;
  const PupilRing* pupil;  ///< rings of equal width, from the film's middle; one or more
  int ring_count;
  double rings_per_length;
  double rear;                     ///< z of the last surface's middle
  double film;                     ///< z of the film
  double half_width, half_height;  ///< of the film
  double scale;                    ///< world units per unit of the lens
  /// 1 / integral of cos^4 over the exit pupil in the middle of the film: weights are relative to
  /// the light that arrives there.
  double exposure;
};

}  // namespace boule
