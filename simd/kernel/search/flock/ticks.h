#pragma once

#include <cstdint>

#include "simd/lanes/lanes.h"

/// Time, for the choice between ways that give the same answers.
namespace boule::BOULE_KERNEL_ISA {

/// A clock that the CPU advances, in ticks of its own, mostly some per 0.1 us. Another core may be
/// behind. On other processors it stands still: then all ways seem alike.
BOULE_INLINE std::uint64_t ticks() {
#if defined(__x86_64__)
  return __builtin_ia32_rdtsc();
#elif defined(__aarch64__)
  std::uint64_t count = 0;
  asm volatile("mrs %0, cntvct_el0" : "=r"(count));
  return count;
#else
  return 0;
#endif
}

}  // namespace boule::BOULE_KERNEL_ISA
