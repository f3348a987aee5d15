// What bench_python.py compares the Python package with, in the same process: the same work by the
// library itself.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/frame/stopwatch.h"
#include "render/renderer/tracer.h"

namespace py = pybind11;

namespace boule {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

Tracer made_of(const float* centers, const float* radii, std::size_t count) {
  Scene scene;
  scene.materials.push_back({"default", Matte{}});
  scene.spheres.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* const c = centers + 3 * i;
    scene.spheres[i] = {{c[0], c[1], c[2]}, radii[i], MaterialRef()};
  }
  auto tracer = Tracer::create(std::move(scene));
  if (!tracer) throw std::runtime_error(tracer.error().message);
  return std::move(tracer).value();
}

/// A Tracer of the library and rays of its own form, kept between runs.
class Native {
 public:
  Native(const Floats& centers, const Floats& radii)
      : tracer_(made_of(centers.data(), radii.data(), static_cast<std::size_t>(radii.size()))) {}

  void set_rays(const Floats& org, const Floats& dir) {
    rays_.resize(static_cast<std::size_t>(org.shape(0)));
    hits_.resize(rays_.size());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const float* const o = org.data() + 3 * i;
      const float* const d = dir.data() + 3 * i;
      rays_[i] = Ray{vec_cast<double>(Vec3f{o[0], o[1], o[2]}), {d[0], d[1], d[2]}};
    }
  }

  /// Seconds that Tracer::closest() takes.
  double closest_seconds() {
    const py::gil_scoped_release no_gil;
    const Stopwatch watch;
    if (auto done = tracer_.closest(rays_, hits_); !done)
      throw std::runtime_error(done.error().message);
    return watch.seconds();
  }

  /// The sum of all ids: both sides found the same.
  [[nodiscard]] std::int64_t id_sum() const {
    std::int64_t sum = 0;
    for (const TracedHit& hit : hits_) sum += hit.id;
    return sum;
  }

 private:
  Tracer tracer_;
  std::vector<Ray> rays_;
  std::vector<TracedHit> hits_;
};

/// Seconds from two arrays to a Tracer.
double build_seconds(const Floats& centers, const Floats& radii) {
  const py::gil_scoped_release no_gil;
  const Stopwatch watch;
  const Tracer tracer =
      made_of(centers.data(), radii.data(), static_cast<std::size_t>(radii.size()));
  return watch.seconds();
}

}  // namespace
}  // namespace boule

PYBIND11_MODULE(boule_bench_native, module) {
  using boule::Native;
  py::class_<Native>(module, "Native")
      .def(py::init<const boule::Floats&, const boule::Floats&>())
      .def("set_rays", &Native::set_rays)
      .def("closest_seconds", &Native::closest_seconds)
      .def("id_sum", &Native::id_sum);
  module.def("build_seconds", &boule::build_seconds);
}
