#include "render/renderer/tracer.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "core/base/float_environment.h"
#include "render/frame/stopwatch.h"
#include "render/memory/scene_memory.h"
#include "render/prepare/scene_geometry.h"
#include "render/renderer/preparation.h"
#include "simd/stream/stream_buffer.h"
#include "simd/stream/surface_buffer.h"

namespace boule {
namespace {

/// Rays per stream: enough to fill packets, and few enough to stay in the cache.
constexpr std::size_t rays_of_stream = 1024;
/// Number of rays whose surfaces are found at a time: few enough for them to stay in the nearest
/// caches.
constexpr std::size_t surface_block_size = 256;

/// The nearest float of a finite number; infinity for infinity and for numbers that are too large.
float to_float(double x) {
  constexpr double too_large = 0x1.ffffffp127;  // halfway from the largest float to 2^128
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (x >= too_large) return infinity;
  return x <= -too_large ? -infinity : static_cast<float>(x);
}

Vec3d vector_at(const RayNumbers& column, std::size_t ray) {
  return {column.at(ray, 0), column.at(ray, 1), column.at(ray, 2)};
}

Ray ray_at(const RayColumns& rays, std::size_t k) {
  const Vec3d dir = vector_at(rays.dir, k);
  Ray ray{vector_at(rays.org, k) - rays.zero, {to_float(dir.x), to_float(dir.y), to_float(dir.z)}};
  ray.tmin = to_float(rays.tmin.at(k));
  ray.tmax = to_float(rays.tmax.at(k));
  return ray;
}

Status wrong_room(std::size_t rays, std::size_t results) {
  if (results == rays) return {};
  return Diagnostic::of("there are " + std::to_string(rays) + " rays, but room for " +
                        std::to_string(results) + " results");
}

}  // namespace

/// One thread's streams, kept from block to block.
struct Tracer::Worker {
  RayBuffer rays;
  HitBuffer hits;
  SurfaceBuffer surfaces{surface_block_size};
  AlignedArray<std::uint8_t> met;
  Experience closest, any;  ///< of all calls: they probably have rays of one kind

  void load(std::span<const Ray> block) {
    rays.resize(block.size());
    for (std::size_t k = 0; k < block.size(); ++k) rays.set(k, block[k]);
  }
  void load(const RayColumns& columns, std::size_t first, std::size_t count) {
    rays.resize(count);
    for (std::size_t k = 0; k < count; ++k) rays.set(k, ray_at(columns, first + k));
  }
};

Tracer::Tracer(Scene scene, const std::optional<std::vector<ShownGroup>>& groups,
               const TraceOptions& options, const KernelTable& kernels)
    : options_(options),
      kernels_(&kernels),
      geometry_(
          geometry_of(scene, groups, scene.planes, Scheduler(options.threads).parallel_for())),
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

/// Calls visit(k, hit, normal) for each ray of the worker's stream; `normal` is 0 for a miss.
template <class Visit>
void Tracer::find_closest(Worker& worker, const Visit& visit) {
  const std::size_t size = worker.rays.size();
  worker.hits.resize(size);
  const GeometryView geometry = geometry_.view();
  const RayStream rays = worker.rays.view();
  const HitStream hits = worker.hits.view();
  const Query query{.solver = options_.solver, .experience = &worker.closest};
  kernels_->closest_hit(geometry, rays, query, hits);
  for (std::size_t first = 0; first < size; first += surface_block_size) {
    const std::size_t count = std::min(surface_block_size, size - first);
    kernels_->find_surfaces(geometry, part(rays, first, count), part(hits, first, count),
                            worker.surfaces.stream());
    for (std::size_t k = 0; k < count; ++k) {
      const Hit hit = worker.hits.get(first + k);
      const bool met = hit.id != no_primitive;
      visit(first + k, hit, met ? vec_cast<float>(worker.surfaces.normal.get(k)) : Vec3f{});
    }
  }
}

void Tracer::find_any(Worker& worker) {
  worker.met.resize(worker.rays.size());
  const Query query{.solver = options_.solver, .experience = &worker.any};
  kernels_->any_hit(geometry_.view(), worker.rays.view(), query, worker.met.data());
}

Status Tracer::closest(std::span<const Ray> rays, std::span<TracedHit> hits) {
  const auto load = [&](Worker& worker, std::size_t first, std::size_t count) {
    worker.load(rays.subspan(first, count));
  };
  const auto body = [&](Worker& worker, std::size_t first) {
    find_closest(worker, [&](std::size_t k, const Hit& hit, const Vec3f& normal) {
      hits[first + k] = {hit.t, hit.id, normal};
    });
  };
  return run(rays.size(), hits.size(), std::cref(load), std::cref(body));
}

Status Tracer::any(std::span<const Ray> rays, std::span<std::uint8_t> met) {
  const auto load = [&](Worker& worker, std::size_t first, std::size_t count) {
    worker.load(rays.subspan(first, count));
  };
  const auto body = [&](Worker& worker, std::size_t first) {
    find_any(worker);
    std::copy_n(worker.met.data(), worker.rays.size(), met.data() + first);
  };
  return run(rays.size(), met.size(), std::cref(load), std::cref(body));
}

Status Tracer::closest_of_columns(const RayColumns& rays, const HitColumns& hits) {
  const auto load = [&](Worker& worker, std::size_t first, std::size_t count) {
    worker.load(rays, first, count);
  };
  const auto body = [&](Worker& worker, std::size_t first) {
    find_closest(worker, [&](std::size_t k, const Hit& hit, const Vec3f& normal) {
      hits.t[first + k] = hit.t;
      hits.id[first + k] = hit.id;
      float* const components = hits.normal + 3 * (first + k);
      components[0] = normal.x;
      components[1] = normal.y;
      components[2] = normal.z;
    });
  };
  return run(rays.size, rays.size, std::cref(load), std::cref(body));
}

Status Tracer::any_of_columns(const RayColumns& rays, std::span<std::uint8_t> met) {
  const auto load = [&](Worker& worker, std::size_t first, std::size_t count) {
    worker.load(rays, first, count);
  };
  const auto body = [&](Worker& worker, std::size_t first) {
    find_any(worker);
    std::copy_n(worker.met.data(), worker.rays.size(), met.data() + first);
  };
  return run(rays.size, met.size(), std::cref(load), std::cref(body));
}

/// Closures are passed by reference, here and above: a copy takes memory, and can throw.
Status Tracer::run(std::size_t rays, std::size_t results, const Load& load, const Body& body) {
  if (workers_.empty()) return Diagnostic::of("the tracer was moved away");
  if (auto done = wrong_room(rays, results); !done) return done;
  const FloatEnvironment environment;
  const Stopwatch watch;
  Status status = run_blocks(rays, load, body);
  trace_seconds_ += watch.seconds();
  return status;
}

/// Calls `body` for each block of the rays, loaded into the worker's stream.
Status Tracer::run_blocks(std::size_t rays, const Load& load, const Body& body) {
  std::atomic<std::size_t> done{0};
  const auto report = [&](double share) {
    if (options_.progress) options_.progress({share, done});
  };
  const auto work = [&](unsigned index, std::size_t block) {
    const std::size_t first = block * rays_of_stream;
    const std::size_t count = std::min(rays_of_stream, rays - first);
    Worker& mine = worker(index);
    load(mine, first, count);
    body(mine, first);
    done += count;
    if (index == 0) report(static_cast<double>(done) / static_cast<double>(rays));
  };
  const std::size_t blocks = rays / rays_of_stream + (rays % rays_of_stream != 0 ? 1 : 0);
  Status status = scheduler_.run(blocks, std::cref(work), options_.cancel);
  rays_ += done;
  if (!status) return status;
  if (done != rays) return Diagnostic::of("tracing was cancelled");
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
