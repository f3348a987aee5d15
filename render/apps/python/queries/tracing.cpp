#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "core/scene/number_text.h"
#include "render/apps/job/options/render_choices.h"
#include "render/apps/python/queries/points.h"
#include "render/apps/python/queries/ray_input.h"
#include "render/apps/python/queries/shared_tracer.h"
#include "render/apps/python/scenes/scenes.h"
#include "render/apps/python/scenes/sphere_arrays.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/errors.h"
#include "render/apps/python/values/job_arguments.h"
#include "render/apps/python/values/presence.h"
#include "render/memory/available_memory.h"
#include "render/renderer/tracer.h"

namespace py = pybind11;

namespace boule::python {
namespace {

using RayHandle = std::shared_ptr<const RayInput>;

RayHandle rays_of(const py::dict& given) { return std::make_shared<const RayInput>(given); }

/// Runs query(tracer, columns), with a thread that waits for signals if it may take long.
template <class Query>
void trace(const TracerHandle& tracer, const RayHandle& rays, const Query& query) {
  ask(tracer, rays->count(),
      [rays, query](Tracer& one, const Vec3d& zero) { return query(one, rays->columns(zero)); });
}

void check_room(std::size_t rays, std::size_t bytes_each) {
  check(check_memory(std::uint64_t{rays} * bytes_each,
                     "the hits of " + std::to_string(rays) + " rays need"));
}

/// A new array; or, if `out` is one, that, which must fit.
template <class Number>
py::array_t<Number> room_in(const py::object& out, const std::string& name,
                            const std::vector<py::ssize_t>& shape) {
  if (out.is_none()) return empty_array<Number>(shape);
  const py::array_t<Number> wanted = empty_array<Number>(std::vector<py::ssize_t>(shape.size(), 0));
  const bool is_array = py::isinstance<py::array>(out) && !is_masked(out);
  const auto array = is_array ? py::reinterpret_borrow<py::array>(out) : py::array();
  const bool fits =
      is_array && array.dtype().is(wanted.dtype()) &&
      std::equal(shape.begin(), shape.end(), array.shape(), array.shape() + array.ndim()) &&
      array.writeable() && (array.flags() & py::array::c_style) != 0;
  if (!fits) {
    throw_error("out", name + ": expected " + std::string(py::str(wanted.dtype())) + " of shape " +
                           std::string(py::str(py::tuple(py::cast(shape)))) +
                           ", in C order and writable, got " +
                           (is_array ? describe(array) : type_name(out)));
  }
  return py::reinterpret_borrow<py::array_t<Number>>(out);
}

py::tuple closest(const TracerHandle& tracer, const py::dict& given, const py::object& out) {
  const RayHandle rays = rays_of(given);
  const auto count = static_cast<py::ssize_t>(rays->count());
  if (out.is_none()) {
    check_room(rays->count(),
               sizeof(double) + sizeof(std::int32_t) + 3 * sizeof(float) + sizeof(bool));
  }
  const auto part = [&](int k) { return out.is_none() ? out : py::object(out[py::int_(k)]); };
  auto t = room_in<double>(part(0), "t", {count});
  auto id = room_in<std::int32_t>(part(1), "id", {count});
  auto normal = room_in<float>(part(2), "normal", {count, 3});
  auto entering = room_in<bool>(part(3), "entering", {count});
  const HitColumns hits{t.mutable_data(), id.mutable_data(), normal.mutable_data(),
                        reinterpret_cast<std::uint8_t*>(entering.mutable_data())};
  const auto arrays = py::make_tuple(t, id, normal, entering);
  trace(tracer, rays, [hits, kept = keep(arrays)](Tracer& one, const RayColumns& columns) {
    return one.closest_of_columns(columns, hits);
  });
  return arrays;
}

/// An array of one value for each ray, set by query(tracer, columns, values).
template <class Number, class Query>
py::array each_ray(const TracerHandle& tracer, const py::dict& given, const py::object& out,
                   const Query& query) {
  const RayHandle rays = rays_of(given);
  if (out.is_none()) check_room(rays->count(), sizeof(Number));
  auto values = room_in<Number>(out, "the array", {static_cast<py::ssize_t>(rays->count())});
  Number* const data = values.mutable_data();
  trace(tracer, rays, [data, query, kept = keep(values)](Tracer& one, const RayColumns& columns) {
    return query(one, columns, std::span<Number>(data, columns.size));
  });
  return values;
}

py::array any(const TracerHandle& tracer, const py::dict& given, const py::object& out) {
  return each_ray<bool>(tracer, given, out,
                        [](Tracer& one, const RayColumns& columns, std::span<bool> met) {
                          auto* const bytes = reinterpret_cast<std::uint8_t*>(met.data());
                          return one.any_of_columns(columns, {bytes, met.size()});
                        });
}

py::array count(const TracerHandle& tracer, const py::dict& given, const py::object& out) {
  return each_ray<std::int64_t>(
      tracer, given, out,
      [](Tracer& one, const RayColumns& columns, std::span<std::int64_t> counts) {
        return one.count(columns, counts);
      });
}

py::array chord(const TracerHandle& tracer, const py::dict& given, const py::object& out) {
  return each_ray<double>(tracer, given, out,
                          [](Tracer& one, const RayColumns& columns, std::span<double> lengths) {
                            return one.chord(columns, lengths);
                          });
}

/// What query(tracer, columns) returns, without its Result.
template <class Query>
auto lists(const TracerHandle& tracer, const py::dict& given, const Query& query) {
  using Lists = std::remove_cvref_t<
      decltype(std::declval<std::invoke_result_t<Query, Tracer&, const RayColumns&>>().value())>;
  const auto found = std::make_shared<Lists>();
  trace(tracer, rays_of(given), [found, query](Tracer& one, const RayColumns& columns) -> Status {
    auto made = query(one, columns);
    if (!made) return made.error();
    *found = std::move(made).value();
    return {};
  });
  return found;
}

py::tuple all_hits(const TracerHandle& tracer, const py::dict& given,
                   std::optional<std::size_t> limit) {
  const auto all = lists(tracer, given, [limit](Tracer& one, const RayColumns& columns) {
    return one.all_hits(columns, limit);
  });
  return py::make_tuple(kept_column<std::int64_t>(all, all->offset),
                        kept_column<double>(all, all->t), kept_column<std::int32_t>(all, all->id),
                        kept_column<bool>(all, all->entering));
}

py::tuple chords(const TracerHandle& tracer, const py::dict& given) {
  const auto all = lists(
      tracer, given, [](Tracer& one, const RayColumns& columns) { return one.chords(columns); });
  return py::make_tuple(kept_column<std::int64_t>(all, all->offset),
                        kept_column<std::int32_t>(all, all->id),
                        kept_column<double>(all, all->length));
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

/// `shown`: from where their Tracer counts rays; none: from where the spheres are counted.
TracerHandle of_spheres(const SphereInput& input, const std::optional<Vec3d>& zero,
                        const std::optional<Vec3d>& shown, const TraceOptions& options) {
  return take(interruptible([=](Call& call) -> Result<TracerHandle> {
    auto placed = place_spheres(input, zero, call.parallel_for());
    if (!placed) return placed.error();
    Scene scene;
    scene.materials.push_back({"default", Matte{}});
    scene.spheres = std::move(placed.value().spheres);
    auto tracer = std::make_shared<SharedTracer>(options, shown.value_or(placed.value().origin));
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
  if (radii.is_none()) return of_scene(source, options);
  return of_spheres({source, radii}, zero, std::nullopt, options);
}

/// A Tracer of the spheres of another one, which count from `zero`: see spheres().
TracerHandle tracer_at(const py::object& centers, const py::object& radii, const py::object& zero,
                       const py::dict& given) {
  return of_spheres({centers, radii}, Vec3d{}, origin_of(zero), options_of(given));
}

/// Moves the spheres of a Tracer that has nothing else. `origin` as in make().
void update(const TracerHandle& tracer, const py::object& centers, const py::object& radii,
            const py::object& origin) {
  const Numbers as_before(centers, "centers", {.rows = tracer->primitives(), .columns = 3});
  const SphereInput input(centers, radii);
  check(interruptible([=, zero = origin_of(origin)](Call& call) -> Status {
    auto placed = place_spheres(input, zero, call.parallel_for());
    if (!placed) return placed.error();
    return tracer->update(placed.value());
  }));
}

/// Centres and radii of the spheres, and the point from which they count.
py::tuple spheres(const TracerHandle& tracer) {
  const auto placed = std::make_shared<PlacedSpheres>();
  {
    const py::gil_scoped_release no_gil;
    *placed = tracer->spheres();
  }
  const auto count = static_cast<py::ssize_t>(placed->spheres.size());
  auto centers = empty_array<float>({count, 3});
  auto radii = empty_array<float>({count});
  float *center = centers.mutable_data(), *radius = radii.mutable_data();
  for (const Sphere& sphere : placed->spheres) {
    for (const float x : {sphere.center.x, sphere.center.y, sphere.center.z}) *center++ = x;
    *radius++ = sphere.radius;
  }
  const Vec3d& zero = placed->origin;
  return py::make_tuple(centers, radii, py::make_tuple(zero.x, zero.y, zero.z));
}

py::dict statistics(const TracerHandle& tracer) {
  TraceStatistics all;
  {
    const py::gil_scoped_release no_gil;
    all = tracer->statistics();
  }
  py::dict values;
  values["rays"] = all.rays;
  values["points"] = all.points;
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
  py::class_<SharedTracer, TracerHandle> tracer(module, "Tracer");
  tracer
      .def(py::init(&make), inside(), py::arg("source"), py::arg("radii"), py::arg("origin"),
           py::arg("options"))
      .def("closest", &closest, inside(), py::arg("rays"), py::arg("out"))
      .def("any", &any, inside(), py::arg("rays"), py::arg("out"))
      .def("all_hits", &all_hits, inside(), py::arg("rays"), py::arg("limit"))
      .def("count", &count, inside(), py::arg("rays"), py::arg("out"))
      .def("chord", &chord, inside(), py::arg("rays"), py::arg("out"))
      .def("chords", &chords, inside(), py::arg("rays"))
      .def("update", &update, inside(), py::arg("centers"), py::arg("radii"), py::arg("origin"))
      .def("spheres", &spheres, inside())
      .def("stats", &statistics, inside());
  module.def("tracer_at", &tracer_at, inside(), py::arg("centers"), py::arg("radii"),
             py::arg("zero"), py::arg("options"));
  bind_points(tracer);
}

}  // namespace boule::python
