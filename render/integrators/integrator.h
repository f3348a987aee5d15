#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/math/color.h"
#include "render/integrators/sample_faults.h"
#include "simd/abi/isa.h"
#include "simd/stream/stream_buffer.h"

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

/// How path tracing seeks the light of spheres and environment images: by rays to them, by where
/// paths happen to go, or by both, weighted. The mean of a picture is the same, its noise is not.
enum class LightSampling { both, lights, paths };

/// How an integrator works.
struct IntegratorSettings {
  Solver solver = Solver::robust;
  int max_depth = 5;       ///< bounces after the primary hit, >= 0
  std::uint64_t seed = 0;  ///< of a path's random numbers
  LightSampling light_sampling = LightSampling::both;
  std::size_t stream_size = 16384;            ///< most rays in one continuation stream, >= 1
  const std::atomic<bool>* cancel = nullptr;  ///< stops soon after it becomes true
};

/// Which sample a camera ray is: what its random numbers depend on.
struct SampleId {
  int x, y;  ///< pixel of the frame
  int sample;
};

/// Camera rays and what is known of them.
struct CameraRays {
  RayBuffer& rays;
  Coherence coherence;
  const SampleId* samples;  ///< one per ray; only path tracing asks for them, else null will do
};

/// Turns camera rays into radiance. One integrator serves one thread: it keeps its working memory
/// from call to call, so that in the steady state nothing is allocated. Any rays will do, those
/// with NaN see the background. Preconditions, not checked: settings in their ranges, as many
/// samples and places for radiance as rays.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// radiance[k] = what arrives along ray k, finite and not negative, whatever the other rays
  /// are. False if it was cancelled: nothing is written then. Throws std::bad_alloc.
  virtual bool trace(const CameraRays& camera, Color* radiance) = 0;

  /// All rays traced by this integrator.
  [[nodiscard]] virtual RayCounts counts() const = 0;

  /// What was wrong with the radiance of its samples before it was made finite.
  [[nodiscard]] virtual SampleFaults faults() const = 0;
};

}  // namespace boule
