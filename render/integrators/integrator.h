#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/math/color.h"
#include "simd/abi/isa.h"
#include "simd/build/stream_buffer.h"

namespace boule {

/// Rays traced so far, by what they were for.
struct RayCounts {
  std::uint64_t primary = 0;
  std::uint64_t shadow = 0;
  std::uint64_t continuation = 0;

  RayCounts& operator+=(const RayCounts& other) {
    primary += other.primary;
    shadow += other.shadow;
    continuation += other.continuation;
    return *this;
  }
  [[nodiscard]] std::uint64_t total() const { return primary + shadow + continuation; }
};

/// How an integrator works.
struct IntegratorSettings {
  Solver solver = Solver::robust;
  int max_depth = 5;                          ///< bounces after the primary hit, >= 0
  std::size_t stream_size = 16384;            ///< most rays in one continuation stream, >= 1
  const std::atomic<bool>* cancel = nullptr;  ///< stops soon after it becomes true
};

/// Turns camera rays into radiance. One integrator serves one thread: it keeps its working memory
/// from call to call, so that in the steady state nothing is allocated.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// radiance[k] = what arrives along rays[k], finite and not negative, whatever the other rays
  /// are. False if it was cancelled: nothing is written then. Throws std::bad_alloc.
  virtual bool trace(RayBuffer& rays, Coherence coherence, Color* radiance) = 0;

  /// All rays traced by this integrator.
  [[nodiscard]] virtual RayCounts counts() const = 0;
};

}  // namespace boule
