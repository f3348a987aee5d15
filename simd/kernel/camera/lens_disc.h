#pragma once

#include <cstddef>

#include "core/math/elementary.h"
#include "simd/abi/stream.h"
#include "simd/lanes/lanes.h"

namespace boule::BOULE_KERNEL_ISA {

/// Places in the unit disc.
struct DiscPoint {
  Wide x, y;
};

/// The places that W lens samples, from `first` on, stand for: concentric squares become circles
/// (Shirley and Chiu, "A low distortion map between disk and square", Journal of Graphics Tools
/// 2(3), 1997). Areas keep their proportions, and the middle stays.
BOULE_INLINE DiscPoint disc_point(const SampleStream& samples, std::size_t first) {
  const Wide x = load(samples.lens_x + first) * Wide(2.0) - Wide(1.0);
  const Wide y = load(samples.lens_y + first) * Wide(2.0) - Wide(1.0);
  const WideMask wide = abs(y) < abs(x);
  const Wide major = select(wide, x, y), minor = select(wide, y, x);
  const WideMask middle = major == Wide(0.0);
  const Wide ratio = minor / select(middle, Wide(1.0), major);
  const Wide angle = Wide(elementary::pi / 4) * ratio;
  const Wide near = major * elementary::cosine(angle * angle);
  const Wide across = major * (angle * elementary::sine_ratio(angle * angle));
  return {select(wide, near, across), select(wide, across, near)};
}

}  // namespace boule::BOULE_KERNEL_ISA
