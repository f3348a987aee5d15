#include "render/apps/python/tracing.h"

#include <pybind11/stl.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/scene/number_text.h"
#include "render/apps/job/render_choices.h"
#include "render/apps/python/arrays.h"
#include "render/apps/python/call.h"
#include "render/apps/python/errors.h"
#include "render/apps/python/job_arguments.h"
#include "render/apps/python/presence.h"
#include "render/apps/python/scenes.h"
#include "render/apps/python/sphere_arrays.h"
#include "render/memory/available_memory.h"
#include "render/renderer/tracer.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// So few rays take less than a millisecond: they are traced without a thread that waits.
constexpr std::size_t few_rays = 2048;

/// A Tracer that any threads may call: one call at a time works, the others wait for it.
class SharedTracer {
 public:
  SharedTracer(TraceOptions options, const Vec3d& zero)
      : options_(std::move(options)), zero_(zero) {
    options_.cancel = &stop_;
    options_.progress = [this](const Progress&) { stop_ = asked_->load(); };
  }

  Status create(Scene&& scene) {
    Result<Tracer> made = Tracer::create(std::move(scene), options_);
    if (!made) return made.error();
    tracer_.emplace(std::move(made).value());
    return {};
  }

  /// Traces, until `cancel` is true.
  template <class Trace>
  Status run(const std::atomic<bool>& cancel, const Trace& trace) {
    const std::lock_guard lock(mutex_);
    asked_ = &cancel;
    stop_ = cancel.load();
    return trace(*tracer_);
  }

  [[nodiscard]] const Vec3d& zero() const { return zero_; }
  [[nodiscard]] TraceStatistics statistics() {
    const std::lock_guard lock(mutex_);
    return tracer_->statistics();
  }

 private:
  TraceOptions options_;
  Vec3d zero_;
  std::mutex mutex_;
  std::atomic<bool> stop_{false};
  const std::atomic<bool>* asked_ = nullptr;  ///< the flag of the call that works
  std::optional<Tracer> tracer_;
};

using TracerHandle = std::shared_ptr<SharedTracer>;

/// The arrays of rays, and what keeps them.
struct RayInput {
  Numbers org, dir, tmin, tmax;
  RayColumns columns{};

  RayInput(const py::object& org_given, const py::object& dir_given, const py::object& tmin_given,
           const py::object& tmax_given)
      : org(org_given, "org", {.columns = 3, .takes_one = true}),
        dir(dir_given, "dir", dir_shape(org)),
        tmin(tmin_given, "tmin", {.rows = count(), .takes_one = true}),
        tmax(tmax_given, "tmax", {.rows = count(), .takes_one = true}) {
    columns = {count(), org.column(), dir.column(), tmin.column(), tmax.column(), {}};
  }

  /// One origin may stand for all rays, and one direction.
  [[nodiscard]] std::size_t count() const { return org.is_one() ? dir.rows() : org.rows(); }

 private:
  static Numbers::Shape dir_shape(const Numbers& org) {
    Numbers::Shape shape{.columns = 3, .takes_one = true};
    if (!org.is_one()) shape.rows = org.rows();
    return shape;
  }
};

/// Runs a query, with a thread that waits for signals if it may take long.
template <class Trace>
void trace(const TracerHandle& tracer, const std::shared_ptr<RayInput>& rays, const Trace& query) {
  rays->columns.zero = tracer->zero();
  if (rays->count() <= few_rays) {
    const std::atomic<bool> never{false};
    Status status;
    {
      const py::gil_scoped_release no_gil;
      status = tracer->run(never, query);
    }
    return check(status);
  }
  check(
      interruptible([tracer, rays, query](Call& call) { return tracer->run(call.cancel, query); }));
}

void check_room(std::size_t rays, std::size_t bytes_each) {
  check(check_memory(std::uint64_t{rays} * bytes_each,
                     "the hits of " + std::to_string(rays) + " rays need"));
}

py::tuple closest(const TracerHandle& tracer, const py::object& org, const py::object& dir,
                  const py::object& tmin, const py::object& tmax) {
  const auto rays = std::make_shared<RayInput>(org, dir, tmin, tmax);
  const auto count = static_cast<py::ssize_t>(rays->count());
  check_room(rays->count(), sizeof(double) + sizeof(std::int32_t) + 3 * sizeof(float));
  auto t = empty_array<double>({count});
  auto id = empty_array<std::int32_t>({count});
  auto normal = empty_array<float>({count, 3});
  const HitColumns hits{t.mutable_data(), id.mutable_data(), normal.mutable_data()};
  const auto kept = keep(py::make_tuple(t, id, normal));
  trace(tracer, rays,
        [rays, hits, kept](Tracer& one) { return one.closest_of_columns(rays->columns, hits); });
  return py::make_tuple(t, id, normal);
}

py::array any(const TracerHandle& tracer, const py::object& org, const py::object& dir,
              const py::object& tmin, const py::object& tmax) {
  const auto rays = std::make_shared<RayInput>(org, dir, tmin, tmax);
  check_room(rays->count(), 1);
  auto met = empty_array<bool>({static_cast<py::ssize_t>(rays->count())});
  auto* const bytes = reinterpret_cast<std::uint8_t*>(met.mutable_data());
  const auto kept = keep(met);
  trace(tracer, rays, [rays, bytes, kept](Tracer& one) {
    return one.any_of_columns(rays->columns, {bytes, rays->columns.size});
  });
  return met;
}

TraceOptions options_of(const py::dict& given) {
  const Arguments arguments(given);
  SceneJob job;
  read_rows(arguments, scene_choices(), job);
  isa_of(arguments);  // refuses one that is not there
  TraceOptions options;
  options.solver = job.solver;
  options.threads = job.threads;
  options.isa = job.isa;
  return options;
}

/// The point that is subtracted; none for "auto".
std::optional<Vec3d> origin_of(const py::object& given) {
  if (given.is_none()) return std::nullopt;
  const Numbers point(given, "origin", {.rows = 3});
  const Vec3d origin{point.at(0), point.at(1), point.at(2)};
  for (const double x : {origin.x, origin.y, origin.z}) {
    if (!std::isfinite(x)) throw_error("origin", "must be finite, is " + number_text(x));
  }
  return origin;
}

TracerHandle of_spheres(const py::object& centers, const py::object& radii,
                        const std::optional<Vec3d>& zero, const TraceOptions& options) {
  const SphereInput input(centers, radii);
  return take(interruptible([=](Call& call) -> Result<TracerHandle> {
    auto placed = place_spheres(input, zero, call.parallel_for());
    if (!placed) return placed.error();
    Scene scene;
    scene.materials.push_back({"default", Matte{}});
    scene.spheres = std::move(placed.value().spheres);
    auto tracer = std::make_shared<SharedTracer>(options, placed.value().origin);
    if (auto done = tracer->create(std::move(scene)); !done) return done.error();
    return tracer;
  }));
}

TracerHandle of_scene(const py::object& source, const TraceOptions& options) {
  const SceneRequest request(source, {});
  return take(interruptible([=](Call& call) -> Result<TracerHandle> {
    auto loaded = request.load(call);
    if (!loaded) return loaded.error();
    auto tracer = std::make_shared<SharedTracer>(options, loaded.value().origin);
    if (auto done = tracer->create(std::move(loaded.value().scene)); !done) return done.error();
    return tracer;
  }));
}

/// A Tracer of spheres in arrays; or, without radii, of a scene.
TracerHandle make(const py::object& source, const py::object& radii, const py::object& origin,
                  const py::dict& given) {
  const TraceOptions options = options_of(given);
  const std::optional<Vec3d> zero = origin_of(origin);
  return radii.is_none() ? of_scene(source, options) : of_spheres(source, radii, zero, options);
}

py::dict statistics(const TracerHandle& tracer) {
  TraceStatistics all;
  {
    const py::gil_scoped_release no_gil;
    all = tracer->statistics();
  }
  py::dict values;
  values["rays"] = all.rays;
  values["prepare_seconds"] = all.prepare_seconds;
  values["trace_seconds"] = all.trace_seconds;
  values["isa"] = std::string(all.isa);
  values["width"] = all.width;
  values["threads"] = all.threads;
  values["solver"] = std::string(name_of(all.solver));
  return values;
}

}  // namespace

void bind_tracing(py::module_& module) {
  py::class_<SharedTracer, TracerHandle>(module, "Tracer")
      .def(py::init(&make), inside(), py::arg("source"), py::arg("radii"), py::arg("origin"),
           py::arg("options"))
      .def("closest", &closest, inside(), py::arg("org"), py::arg("dir"), py::arg("tmin"),
           py::arg("tmax"))
      .def("any", &any, inside(), py::arg("org"), py::arg("dir"), py::arg("tmin"), py::arg("tmax"))
      .def("stats", &statistics, inside());
}

}  // namespace boule::python
