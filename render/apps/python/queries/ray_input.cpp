#include "render/apps/python/queries/ray_input.h"

#include <string>

namespace py = pybind11;

namespace boule::python {
namespace {

/// Truth values as numbers; anything else as it is.
py::object truths(const py::object& given, const std::string& name) {
  const py::array array = to_array(given, name);
  if (array.dtype().kind() != 'b') return given;
  return array.attr("astype")("float32");
}

}  // namespace

RayInput::RayInput(const py::dict& given)
    : org_(given["org"], "org", {.columns = 3, .takes_one = true}),
      dir_(given["dir"], "dir", dir_shape()),
      tmin_(given["tmin"], "tmin", each()),
      tmax_(given["tmax"], "tmax", each()),
      source_(given["source"], "source", each()),
      inside_(truths(given["inside"], "inside"), "inside", each()) {}

Numbers::Shape RayInput::dir_shape() const {
  Numbers::Shape shape{.columns = 3, .takes_one = true};
  if (!org_.is_one()) shape.rows = org_.rows();
  return shape;
}

RayColumns RayInput::columns(const Vec3d& zero) const {
  return {count(),        org_.column(), dir_.column(),    tmin_.column(),
          tmax_.column(), zero,          source_.column(), inside_.column()};
}

}  // namespace boule::python
