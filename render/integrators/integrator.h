#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/math/color.h"
#include "core/math/coverage.h"
#include "core/math/sample_id.h"
#include "render/integrators/sample_faults.h"
#include "render/prepare/fog.h"
#include "simd/abi/isa.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

class RayRecord;

/// The number of traced rays, by kind.
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

/// The way in which path tracing finds the light of spheres and environment images. The expected
/// picture is the same for all three; the noise differs.
/// - both: by light sampling and by the directions of paths, weighted (multiple importance
///   sampling).
/// - lights: by light sampling only (next-event estimation).
/// - paths: by the directions of paths only.
enum class LightSampling { both, lights, paths };

/// The settings of an integrator.
struct IntegratorSettings {
  Solver solver = Solver::robust;
  int max_depth = 5;       ///< bounces after the primary hit, >= 0
  std::uint64_t seed = 0;  ///< of the random numbers of paths
  /// Whitted only: rays are left out whose weights in a sample add up to at most this, 0 .. 1.
  float least_weight = 0;
  /// The lecture's epsilon, 0 or more, at which shadow rays start: start_by_epsilon(). Without it,
  /// shadow rays know the surface that they leave. For teaching.
  std::optional<float> shadow_epsilon{};
  /// Whitted only: receives the rays of one camera ray; null: off. Requires a stream_size of 1.
  RayRecord* record = nullptr;
  Fog fog{};  ///< in front of what camera rays hit; not of a record
  LightSampling light_sampling = LightSampling::both;
  std::size_t stream_size = 16384;            ///< largest number of rays in one continuation
                                              ///< stream, >= 1
  const std::atomic<bool>* cancel = nullptr;  ///< stops soon after it becomes true
};

/// Camera rays, and the known facts about them.
struct CameraRays {
  RayBuffer& rays;
  Coherence coherence;      ///< what the rays have in common
  const SampleId* samples;  ///< of each ray; may be null except for path tracing
  /// Room for one number per ray, which becomes 0 if the ray misses, otherwise whole_coverage less
  /// the share of fog; null: off.
  std::uint8_t* covered = nullptr;
};

/// Turns camera rays into radiance. One integrator serves one thread. It reuses its working memory,
/// so after the first calls it allocates nothing. Takes any rays; those with NaN see the
/// background. Precondition: the settings are in their ranges.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Sets radiance[k] to the radiance that arrives along ray k, finite and at least 0; it is
  /// independent of the other rays. Returns false after a cancellation, with nothing written.
  /// Precondition: `radiance` has room for one colour per ray.
  virtual bool trace(const CameraRays& camera, Color* radiance) = 0;

  /// All rays that this integrator traced.
  [[nodiscard]] virtual RayCounts counts() const = 0;

  /// The faults in the radiance of its samples before settled().
  [[nodiscard]] virtual SampleFaults faults() const = 0;
};

}  // namespace boule
