#include "render/renderer/tracer.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "core/base/float_environment.h"
#include "core/scene/number_text.h"
#include "render/frame/stopwatch.h"
#include "render/memory/scene_memory.h"
#include "render/prepare/scene_geometry.h"
#include "render/renderer/preparation.h"
#include "render/renderer/queries/trace_worker.h"

namespace boule {

Status Tracer::check_room(const char* what, std::size_t asked, std::size_t results) {
  if (results == asked) return {};
  return Diagnostic::of("there are " + std::to_string(asked) + " " + what + ", but room for " +
                        std::to_string(results) + " results");
}

Diagnostic Tracer::moved_away() { return Diagnostic::of("the tracer was moved away"); }

Tracer::Tracer(Scene scene, const std::optional<std::vector<ShownGroup>>& groups,
               const TraceOptions& options, const KernelTable& kernels)
    : options_(options),
      kernels_(&kernels),
      geometry_(geometry_of(scene, groups, Scheduler(options.threads).parallel_for())),
      view_(geometry_.view()),
      built_cost_(geometry_.cost()),
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

/// A copy of the scene is made within the guard.
template <class AnyScene>
Result<Tracer> Tracer::create_from(AnyScene&& scene, const TraceOptions& options) {
  const Stopwatch watch;
  return guard_preparation([&]() -> Result<Tracer> {
    if (auto done = check_scene_memory(scene); !done) return done.error();
    if (options.solver == Solver::reference) {
      if (auto done = check_reference_memory(scene); !done) return done.error();
    }
    if (auto done = validate(scene); !done) return done.error();
    const auto kernels = kernels_for(options.isa, options.solver);
    if (!kernels) return kernels.error();
    if (count_primitives(scene).total() > max_primitives) {
      return Diagnostic::about("instance", "shows more than " + std::to_string(max_primitives) +
                                               " primitives: hits of rays have no ids for them");
    }
    Scene objects(std::forward<AnyScene>(scene));
    const auto groups = share_or_expand(objects);
    Tracer tracer(std::move(objects), groups, options, *kernels.value());
    tracer.prepare_seconds_ = watch.seconds();
    return tracer;
  });
}

TraceTarget Tracer::target() const { return {*kernels_, geometry_, view_, options_.solver}; }

Status Tracer::closest(std::span<const Ray> rays, std::span<TracedHit> hits) {
  const auto body = [&](TraceWorker& worker, std::size_t first) {
    worker.find_closest(target(),
                        [&](std::size_t k, const TracedHit& hit) { hits[first + k] = hit; });
  };
  return run(rays, hits.size(), std::cref(body));
}

/// answer(worker), on the caller's thread.
template <class Answer>
auto Tracer::answer_one(const Answer& answer)
    -> Result<decltype(answer(std::declval<TraceWorker&>()))> {
  if (workers_.empty()) return moved_away();
  const BriefFloatEnvironment environment;
  try {
    const auto found = answer(worker(0));
    ++rays_;
    return found;
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory for a ray");
  }
}

Result<TracedHit> Tracer::closest(const Ray& ray) {
  return answer_one([&](TraceWorker& mine) { return mine.find_closest(target(), ray); });
}

Result<bool> Tracer::any(const Ray& ray) {
  return answer_one([&](TraceWorker& mine) { return mine.find_any(target(), ray); });
}

Status Tracer::any(std::span<const Ray> rays, std::span<std::uint8_t> met) {
  return find_any(rays, met);
}

Status Tracer::closest_of_columns(const RayColumns& rays, const HitColumns& hits) {
  const auto body = [&](TraceWorker& worker, std::size_t first) {
    worker.find_closest(target(), [&](std::size_t k, const TracedHit& hit) {
      hits.t[first + k] = hit.t;
      hits.id[first + k] = hit.id;
      float* const components = hits.normal + 3 * (first + k);
      components[0] = hit.normal.x;
      components[1] = hit.normal.y;
      components[2] = hit.normal.z;
      if (hits.entering != nullptr) hits.entering[first + k] = hit.entering ? 1 : 0;
    });
  };
  return run(rays, rays.size, std::cref(body));
}

Status Tracer::any_of_columns(const RayColumns& rays, std::span<std::uint8_t> met) {
  return find_any(rays, met);
}

Status Tracer::find_any(const RayView& rays, std::span<std::uint8_t> met) {
  const auto body = [&](TraceWorker& worker, std::size_t first) {
    std::copy_n(worker.find_any(target()), worker.size(), met.data() + first);
  };
  return run(rays, met.size(), std::cref(body));
}

/// An error about the first ray whose source is no id.
Status Tracer::check_sources(const RayView& rays) const {
  const RayColumns* const columns = rays.columns();
  if (columns == nullptr || columns->source.first == nullptr) return {};
  const RayNumbers& source = columns->source;
  const std::size_t ids = primitives();
  const std::size_t rows =
      source.ray_step == 0 ? std::min<std::size_t>(rays.size(), 1) : rays.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const double id = source.at(row);
    if (id >= -1 && id < static_cast<double>(ids) && id == std::floor(id)) continue;
    return Diagnostic::about("source", "row " + std::to_string(row) +
                                           ": must be -1 or an id below " + std::to_string(ids) +
                                           ", is " + number_text(id));
  }
  return {};
}

Status Tracer::run(const RayView& rays, std::size_t results, const Body& body) {
  if (workers_.empty()) return moved_away();
  if (auto done = check_room("rays", rays.size(), results); !done) return done;
  if (auto done = check_sources(rays); !done) return done;
  const FloatEnvironment environment;
  const Stopwatch watch;
  Status status = run_rays(rays, body);
  trace_seconds_ += watch.seconds();
  return status;
}

/// Calls `body` for each block of the rays, loaded by the worker. Closures are passed by reference:
/// a copy takes memory, and can throw.
Status Tracer::run_rays(const RayView& rays, const Body& body) {
  const std::size_t all = rays.size();
  std::atomic<std::size_t> done{0};
  const auto work = [&](unsigned index, std::size_t block) {
    const std::size_t first = block * rays_of_stream;
    TraceWorker& mine = worker(index);
    mine.load(std::min(rays_of_stream, all - first),
              [&](std::size_t k) { return rays.at(first + k); });
    body(mine, first);
  };
  Status status = run_blocks({all, rays_of_stream}, std::cref(work), done);
  rays_ += done;
  if (!status) return status;
  const auto end = [&] {
    if (options_.progress) options_.progress({1.0, done});
  };
  return diagnose(std::cref(end));
}

Status Tracer::run_blocks(const Blocks& blocks, const BlockWork& work,
                          std::atomic<std::size_t>& done) {
  const auto body = [&](unsigned index, std::size_t block) {
    work(index, block);
    done += std::min(blocks.size, blocks.all - block * blocks.size);
    if (index == 0 && options_.progress)
      options_.progress({static_cast<double>(done) / static_cast<double>(blocks.all), done});
  };
  Status status = scheduler_.run(blocks.count(), std::cref(body), options_.cancel);
  if (status && done != blocks.all) return Diagnostic::of("tracing was cancelled");
  return status;
}

TraceWorker& Tracer::worker(unsigned index) {
  if (!workers_[index]) workers_[index] = std::make_unique<TraceWorker>();
  return *workers_[index];
}

std::size_t Tracer::primitives() const {
  return geometry_.sphere_count() + geometry_.plane_count() + geometry_.capsule_count();
}

TraceStatistics Tracer::statistics() const {
  return {{prepare_seconds_, isa_name(kernels_->isa), kernels_->width, options_.solver,
           scheduler_.threads_used()},
          rays_,
          points_,
          trace_seconds_};
}

}  // namespace boule
