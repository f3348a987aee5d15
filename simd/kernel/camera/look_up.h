#pragma once

#include <cstddef>

#include "core/math/number.h"
#include "simd/lanes/lanes.h"

namespace boule::BOULE_KERNEL_ISA {

/// look_up() of core/math/number.h for W numbers at a time: lane by lane.
template <std::size_t count, std::size_t n, class Find>
BOULE_INLINE Numbers<Wide, count> look_up(const Numbers<Wide, n>& given, const Find& find) {
  alignas(64) double in[n][width], out[count][width];
  for (std::size_t k = 0; k < n; ++k) store(in[k], given.at[k]);
  for (std::size_t lane = 0; lane < width; ++lane) {
    find(SpacedNumbers{in[0] + lane, width}, SpacedNumbers{out[0] + lane, width});
  }
  Numbers<Wide, count> found;
  for (std::size_t k = 0; k < count; ++k) found.at[k] = load(out[k]);
  return found;
}

}  // namespace boule::BOULE_KERNEL_ISA
