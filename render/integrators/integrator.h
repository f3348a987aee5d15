#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/math/color.h"
#include "core/math/sample_id.h"
#include "render/integrators/sample_faults.h"
#include "simd/abi/isa.h"
#include "simd/stream/stream_buffer.h"

namespace boule {

class RayRecord;

/// How many rays were traced, by kind.
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

/// How path tracing finds the light of spheres and environment images. The expected picture is the
/// same for all three, but not its noise.
/// - both: by light sampling and by the directions of paths, weighted (multiple importance
///   sampling).
/// - lights: by light sampling only (next-event estimation).
/// - paths: by the directions of paths only.
enum class LightSampling { both, lights, paths };

/// How an integrator works.
struct IntegratorSettings {
  Solver solver = Solver::robust;
  int max_depth = 5;       ///< bounces after the primary hit, >= 0
  std::uint64_t seed = 0;  ///< of the random numbers of paths
  /// None: shadow rays know which surface they leave. Else they start by the lecture's epsilon, 0
  /// or more: start_by_epsilon(). For teaching.
  std::optional<float> shadow_epsilon{};
  /// Whitted only: keeps the rays of one camera ray; null: nobody asks. Then stream_size is 1.
  RayRecord* record = nullptr;
  LightSampling light_sampling = LightSampling::both;
  std::size_t stream_size = 16384;            ///< most rays in one continuation stream, >= 1
  const std::atomic<bool>* cancel = nullptr;  ///< stops soon after it becomes true
};

/// Camera rays, and what is known of them.
struct CameraRays {
  RayBuffer& rays;
  Coherence coherence;      ///< what they have in common
  const SampleId* samples;  ///< of each ray; null will do except for path tracing
  /// Room for one number per ray, which becomes 1 where the ray hits something, else 0; null where
  /// nobody asks.
  std::uint8_t* covered = nullptr;
};

/// Turns camera rays into radiance. One integrator serves one thread. It keeps its working memory
/// from call to call, so after the first calls it allocates nothing. Takes any rays; those with NaN
/// see the background. Precondition: the settings are in their ranges.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Sets radiance[k] to what arrives along ray k, finite and not negative; it does not depend on
  /// the other rays. False if it was cancelled, and then nothing is written. Precondition:
  /// `radiance` has room for one colour per ray.
  virtual bool trace(const CameraRays& camera, Color* radiance) = 0;

  /// All rays that this integrator traced.
  [[nodiscard]] virtual RayCounts counts() const = 0;

  /// What was wrong with the radiance of its samples before it was settled().
  [[nodiscard]] virtual SampleFaults faults() const = 0;
};

}  // namespace boule
