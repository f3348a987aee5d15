#include "render/apps/python/queries/points.h"

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/presence.h"
#include "render/memory/available_memory.h"

namespace py = pybind11;

namespace boule::python {
namespace {

using PointHandle = std::shared_ptr<const Numbers>;

PointHandle points_of(const py::object& given) {
  return std::make_shared<const Numbers>(given, "points",
                                         Numbers::Shape{.columns = 3, .takes_one = true});
}

PointColumns point_columns(const Numbers& points, const Vec3d& zero) {
  return {points.rows(), points.column(), zero};
}

void check_point_room(std::size_t points, std::size_t bytes_each) {
  check(check_memory(std::uint64_t{points} * bytes_each,
                     "the answers to " + std::to_string(points) + " points need"));
}

/// Arrays of N x k.
py::tuple nearest(const TracerHandle& tracer, const py::object& given, std::size_t k,
                  double limit) {
  const PointHandle points = points_of(given);
  check_point_room(points->rows(), k * (sizeof(double) + sizeof(std::int32_t)));
  const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(points->rows()),
                                          static_cast<py::ssize_t>(k)};
  auto distance = empty_array<double>(shape);
  auto id = empty_array<std::int32_t>(shape);
  const NearestColumns found{distance.mutable_data(), id.mutable_data()};
  const auto arrays = py::make_tuple(distance, id);
  ask(tracer, points->rows(),
      [points, k, limit, found, kept = keep(arrays)](Tracer& one, const Vec3d& zero) {
        return one.nearest(point_columns(*points, zero), k, limit, found);
      });
  return arrays;
}

py::array first_inside(const TracerHandle& tracer, const py::object& given) {
  const PointHandle points = points_of(given);
  check_point_room(points->rows(), sizeof(std::int32_t));
  auto ids = empty_array<std::int32_t>({static_cast<py::ssize_t>(points->rows())});
  const std::span<std::int32_t> found(ids.mutable_data(), points->rows());
  ask(tracer, points->rows(), [points, found, kept = keep(ids)](Tracer& one, const Vec3d& zero) {
    return one.first_inside(point_columns(*points, zero), found);
  });
  return ids;
}

/// Moves a result out of its Result, for the GIL's thread to read.
template <class Value>
Status put(Result<Value> made, Value& found) {
  if (!made) return made.error();
  found = std::move(made).value();
  return {};
}

py::tuple members(const TracerHandle& tracer, const py::object& given, const py::object& radius) {
  const PointHandle points = points_of(given);
  const auto radii = std::make_shared<const Numbers>(
      radius, "radius", Numbers::Shape{.rows = points->rows(), .takes_one = true});
  const auto found = std::make_shared<Members>();
  ask(tracer, points->rows(), [points, radii, found](Tracer& one, const Vec3d& zero) {
    return put(one.within(point_columns(*points, zero), radii->column()), *found);
  });
  return py::make_tuple(kept_column<std::int64_t>(found, found->offset),
                        kept_column<std::int32_t>(found, found->id));
}

py::tuple pairs(const TracerHandle& tracer, double gap) {
  const auto found = std::make_shared<SpherePairs>();
  ask(tracer, std::numeric_limits<std::size_t>::max(),
      [gap, found](Tracer& one, const Vec3d&) { return put(one.pairs(gap), *found); });
  return py::make_tuple(kept_column<std::int32_t>(found, found->first),
                        kept_column<std::int32_t>(found, found->second),
                        kept_column<double>(found, found->gap));
}

}  // namespace

void bind_points(py::class_<SharedTracer, TracerHandle>& tracer) {
  tracer.def("nearest", &nearest, inside(), py::arg("points"), py::arg("k"), py::arg("limit"))
      .def("members", &members, inside(), py::arg("points"), py::arg("radius"))
      .def("first_inside", &first_inside, inside(), py::arg("points"))
      .def("pairs", &pairs, inside(), py::arg("gap"));
}

}  // namespace boule::python
