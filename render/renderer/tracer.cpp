#include "render/renderer/tracer.h"

#include <algorithm>
#include <new>
#include <utility>

#include "core/base/float_environment.h"
#include "core/scene/instances.h"
#include "core/surface.h"
#include "render/frame/stopwatch.h"
#include "render/memory/scene_memory.h"
#include "render/renderer/preparation.h"
#include "simd/stream/stream_buffer.h"

namespace boule {
namespace {

/// Rays per stream: enough to fill packets, and few enough to stay in the cache.
constexpr std::size_t block_size = 1024;

}  // namespace

/// One thread's streams, kept from block to block.
struct Tracer::Worker {
  RayBuffer rays;
  HitBuffer hits;
  AlignedArray<std::uint8_t> met;

  void load(std::span<const Ray> block) {
    rays.resize(block.size());
    for (std::size_t k = 0; k < block.size(); ++k) rays.set(k, block[k]);
  }
};

Tracer::Tracer(Scene scene, const TraceOptions& options, const KernelTable& kernels)
    : options_(options),
      kernels_(&kernels),
      spheres_(std::move(scene.spheres)),
      planes_(std::move(scene.planes)),
      geometry_(spheres_, planes_, Structure::automatic, Scheduler(options.threads).parallel_for()),
      scheduler_(options.threads),
      workers_(scheduler_.workers()) {}

Tracer::Tracer(Tracer&& other) noexcept = default;
Tracer& Tracer::operator=(Tracer&& other) noexcept = default;
Tracer::~Tracer() = default;

Result<Tracer> Tracer::create(const Scene& scene, const TraceOptions& options) {
  return create_from(scene, options);
}

Result<Tracer> Tracer::create(Scene&& scene, const TraceOptions& options) {
  return create_from(std::move(scene), options);
}

/// If the scene is copied, it is copied within the guard.
template <class AnyScene>
Result<Tracer> Tracer::create_from(AnyScene&& scene, const TraceOptions& options) {
  const Stopwatch watch;
  return guard_preparation([&]() -> Result<Tracer> {
    if (auto bad = check_scene_memory(scene)) return *bad;
    if (auto bad = validate(scene)) return *bad;
    const auto kernels = kernels_for(options.isa, options.solver);
    if (!kernels) return kernels.error();
    Scene objects(std::forward<AnyScene>(scene));
    expand_instances(objects);
    Tracer tracer(std::move(objects), options, *kernels.value());
    tracer.prepare_seconds_ = watch.seconds();
    return tracer;
  });
}

Status Tracer::closest(std::span<const Ray> rays, std::span<TracedHit> hits) {
  const GeometryView geometry = geometry_.view();
  const auto body = [&](Worker& worker, std::size_t first) {
    const std::size_t count = worker.rays.size();
    worker.hits.resize(count);
    kernels_->closest_hit(geometry, worker.rays.view(), {options_.solver}, worker.hits.view());
    for (std::size_t k = 0; k < count; ++k) {
      const Hit hit = worker.hits.get(k);
      TracedHit& result = hits[first + k];
      result = {hit.t, hit.id, {}};
      if (hit.id == no_primitive) continue;
      const Surface surface = find_surface(spheres_, planes_, rays[first + k], hit);
      result.normal = vec_cast<float>(surface.normal);
    }
  };
  return run(rays, hits.size(), std::cref(body));
}

Status Tracer::any(std::span<const Ray> rays, std::span<std::uint8_t> met) {
  const GeometryView geometry = geometry_.view();
  const auto body = [&](Worker& worker, std::size_t first) {
    const std::size_t count = worker.rays.size();
    worker.met.resize(count);
    kernels_->any_hit(geometry, worker.rays.view(), {options_.solver}, worker.met.data());
    std::copy_n(worker.met.data(), count, met.data() + first);
  };
  return run(rays, met.size(), std::cref(body));
}

/// Closures are passed by reference, here and above: a copy takes memory, and can throw.
Status Tracer::run(std::span<const Ray> rays, std::size_t results, const Body& body) {
  if (workers_.empty()) return Diagnostic::of("the tracer was moved away");
  if (results != rays.size()) {
    return Diagnostic::of("there are " + std::to_string(rays.size()) + " rays, but room for " +
                          std::to_string(results) + " results");
  }
  const FloatEnvironment environment;
  const Stopwatch watch;
  Status status = run_blocks(rays, body);
  trace_seconds_ += watch.seconds();
  return status;
}

/// Calls `body` for each block of the rays, loaded into the worker's stream.
Status Tracer::run_blocks(std::span<const Ray> rays, const Body& body) {
  std::atomic<std::size_t> done{0};
  const auto report = [&](double share) {
    if (options_.progress) options_.progress({share, done});
  };
  const auto work = [&](unsigned index, std::size_t block) {
    const std::size_t first = block * block_size;
    const auto part = rays.subspan(first, std::min(block_size, rays.size() - first));
    Worker& mine = worker(index);
    mine.load(part);
    body(mine, first);
    done += part.size();
    if (index == 0) report(static_cast<double>(done) / static_cast<double>(rays.size()));
  };
  const std::size_t blocks = rays.size() / block_size + (rays.size() % block_size != 0 ? 1 : 0);
  Status status = scheduler_.run(blocks, std::cref(work), options_.cancel);
  rays_ += done;
  if (status) return status;
  if (done != rays.size()) return Diagnostic::of("tracing was cancelled");
  const auto end = [&] { report(1); };
  return diagnose(std::cref(end));
}

Tracer::Worker& Tracer::worker(unsigned index) {
  if (!workers_[index]) workers_[index] = std::make_unique<Worker>();
  return *workers_[index];
}

TraceStatistics Tracer::statistics() const {
  return {{prepare_seconds_, isa_name(kernels_->isa), kernels_->width, options_.solver,
           scheduler_.threads_used()},
          rays_,
          trace_seconds_};
}

}  // namespace boule
