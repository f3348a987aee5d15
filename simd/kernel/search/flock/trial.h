#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/flock/ticks.h"
#include "simd/kernel/tuning.h"

/// What trials by the clock have in common: those between sets, packets and flights or sorted rays
/// (scattered.cpp), and those between sorted and unsorted shadow rays (bundle/shadow_stream.h).
namespace boule::BOULE_KERNEL_ISA {

/// The ticks since `start`.
BOULE_INLINE float ticks_since(std::uint64_t start) {
  const std::uint64_t now = ticks();
  return start < now ? static_cast<float>(now - start) : 0.0F;
}

/// Whether one way costs so much less than another one that few trials are needed.
BOULE_INLINE bool costs_clearly_less(float cost, float other) {
  return tuning::clearly_more * cost < other;
}

/// The number of rays that rely on a trial: `least`, or if it agrees with the trial before, on
/// which `before` rays relied, more: if it is clear, `most`. One trial alone may have been
/// interrupted, because the system also runs other programs on the processor.
BOULE_INLINE std::uint32_t rays_after_trial(bool agrees, std::uint32_t before, bool is_clear,
                                            std::size_t least, std::size_t most) {
  if (!agrees) return static_cast<std::uint32_t>(least);
  const std::size_t rays = is_clear ? most : tuning::growth_while_agreed * before;
  return static_cast<std::uint32_t>(rays < least ? least : rays > most ? most : rays);
}

}  // namespace boule::BOULE_KERNEL_ISA
