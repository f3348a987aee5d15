#pragma once

#include "core/optics/lens_optics.h"

namespace boule {

/// The integral of cos^4 over the exit pupil in the film's middle, exact to rounding, in the lens'
/// unit squared: there the pupil is round, and the radii of its edges say all. 0: nothing passes,
/// or no more than a billionth of the last surface's width does. Precondition: a lens with
/// elements, as all here.
double light_in_the_middle(const LensOptics& optics);

/// Sets the pupil, in so many rings, 1 or more, and the exposure of a lens whose elements and film
/// are set. Numbers that are not finite make such numbers. Throws std::bad_alloc.
void find_pupil(LensOptics& optics, int rings);

}  // namespace boule
