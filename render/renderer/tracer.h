#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/math/ray.h"
#include "core/scene/scene.h"
#include "render/frame/progress.h"
#include "render/frame/scheduler.h"
#include "render/frame/traced_hit.h"
#include "render/renderer/run_statistics.h"
#include "simd/abi/kernel_table.h"
#include "simd/geometry/geometry.h"

namespace boule {

/// How rays are traced. Of all this only solver fast shows in the hits.
struct TraceOptions {
  Solver solver = Solver::robust;
  unsigned threads = 0;                           ///< 0: as many as the hardware runs; at most 1024
  std::string isa = "auto";                       ///< a name that select_kernels() knows
  const std::atomic<bool>* cancel = nullptr;      ///< true: tracing stops soon; outlives the tracer
  std::function<void(const Progress&)> progress;  ///< called often, on the thread that traces
};

/// What tracing has cost so far, over all calls.
struct TraceStatistics : RunStatistics {
  std::uint64_t rays = 0;
  double trace_seconds = 0;
};

/// The objects of a scene, ready for rays: the public face for whoever brings rays of their own.
/// Camera, lights and materials are not needed. The bits of a hit depend on neither ISA, threads
/// nor the other rays; the caller's rounding mode, denormal flags and traps do not matter and are
/// left as they were. Nothing here throws: what fails, a progress callback too, is a Diagnostic.
/// The calling thread needs 2 MiB of stack. Any ray may be asked for: one with NaN, with an
/// infinite origin or direction, or without a direction is a miss. One call at a time. Of a tracer
/// that was moved away closest() and any() are errors.
class Tracer {
 public:
  /// Prepares the objects; the scene is not needed any more afterwards. Takes any values: an error
  /// if the scene is invalid (validate()), the ISA is not to be had, or the memory does not
  /// suffice.
  static Result<Tracer> create(const Scene& scene, const TraceOptions& options = {});
  /// The same without a copy of the spheres and planes.
  static Result<Tracer> create(Scene&& scene, const TraceOptions& options = {});
  Tracer(Tracer&& other) noexcept;
  Tracer& operator=(Tracer&& other) noexcept;
  ~Tracer();

  /// hits[k] = the nearest hit of rays[k] with tmin < t <= tmax; equal t: the lower id. The normal
  /// is that of the view `normal`. An error if there are not as many hits as rays, if the memory
  /// does not suffice, or cancelled: then some hits may be missing.
  Status closest(std::span<const Ray> rays, std::span<TracedHit> hits);

  /// met[k] = 1 if rays[k] meets anything with tmin < t <= tmax, else 0: as closest() would tell,
  /// in less time. Errors likewise.
  Status any(std::span<const Ray> rays, std::span<std::uint8_t> met);

  [[nodiscard]] TraceStatistics statistics() const;

 private:
  struct Worker;
  using Body = std::function<void(Worker& worker, std::size_t first)>;

  template <class AnyScene>
  static Result<Tracer> create_from(AnyScene&& scene, const TraceOptions& options);
  Tracer(Scene scene, const TraceOptions& options, const KernelTable& kernels);
  Status run(std::span<const Ray> rays, std::size_t results, const Body& body);
  Status run_blocks(std::span<const Ray> rays, const Body& body);
  Worker& worker(unsigned index);

  TraceOptions options_;
  const KernelTable* kernels_;
  std::vector<Sphere> spheres_;
  std::vector<Plane> planes_;
  Geometry geometry_;
  Scheduler scheduler_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::uint64_t rays_ = 0;
  double prepare_seconds_ = 0;
  double trace_seconds_ = 0;
};

}  // namespace boule
