#pragma once

#include <vector>

#include "core/optics/lens_view.h"
#include "core/scene/lens.h"

namespace boule {

/// A lens, focused and ready to be traced. It owns the numbers of a LensView, which documents them.
struct LensOptics {
  std::vector<LensElement> elements;
  std::vector<PupilRing> pupil;
  double rings_per_length;
  double rear;
  double film;
  double half_width, half_height;
  double scale;
  double exposure;

  /// A view that is valid until this lens is changed or destroyed; it survives a move.
  [[nodiscard]] LensView view() const;
};

/// A valid camera's lens (find_problem()), focused, with its exit pupil in `rings` rings, for a
/// picture of `width` x `height` pixels, all 1 or more. Other lenses and sizes give numbers that
/// may be NaN, and rays that are stopped. Throws std::bad_alloc.
LensOptics make_optics(const LensCamera& camera, int width, int height, int rings = 64);

/// The light that the middle of such a camera's film gathers: light_in_the_middle(). 0 for a camera
/// without surfaces. Throws std::bad_alloc.
double gathered_light(const LensCamera& camera);

/// Sends a ray of unit direction from the film through the elements; false if it is stopped: see
/// pass_element().
bool trace_lens(const std::vector<LensElement>& elements, Vec3d& org, Vec3d& dir);

}  // namespace boule
