#pragma once

#include "core/optics/lens_optics.h"

namespace boule {

/// The integral of cos^4 over the exit pupil of the film's middle, exact to rounding, in the lens'
/// unit squared. The pupil is round there: the integral follows from the radii of its edges. 0: no
/// light passes, or only within a billionth of the last surface's width. Precondition, here and
/// below: a lens with elements.
double light_in_the_middle(const LensOptics& optics);

/// Sets the pupil, in `rings` rings, 1 or more, and the exposure of a lens whose elements and film
/// are set. Numbers that are not finite give such numbers. Throws std::bad_alloc.
void find_pupil(LensOptics& optics, int rings);

}  // namespace boule
