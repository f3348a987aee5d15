#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "core/base/version.h"
#include "render/apps/job/options/option_values.h"
#include "render/apps/python/pictures/picture.h"
#include "render/apps/python/scenes/scenes.h"
#include "render/apps/python/scenes/sphere_arrays.h"
#include "render/apps/python/scenes/tables.h"
#include "render/apps/python/values/arrays.h"
#include "render/apps/python/values/bindings.h"
#include "render/apps/python/values/call.h"
#include "render/apps/python/values/errors.h"
#include "render/files/particle_file/bridge/bridge_reader.h"
#include "render/files/particle_file/particle_file.h"
#include "simd/dispatch/dispatch.h"

namespace py = pybind11;

namespace boule::python {
namespace {

/// The instruction set that runs where none is asked for.
std::string isa() { return std::string(isa_name(take(select_kernels("auto"))->isa)); }

}  // namespace
}  // namespace boule::python

PYBIND11_MODULE(_core, module) {
  using namespace boule::python;
  module.doc() = "The compiled part of boule. Use boule itself.";
  module.attr("version") = boule::library_version();
  module.attr("numpy_below") = numpy_below;
  bind_errors(module);
  bind_tables(module);
  bind_scenes(module);
  bind_data(module);
  bind_particle_arrays(module);
  bind_sphere_arrays(module);
  bind_capsule_arrays(module);
  bind_tracing(module);
  bind_camera_rays(module);
  bind_picture(module);
  bind_rendering(module);
  bind_pickling(module);
  bind_ends_of_calls(module);
  module.def("isa", &isa);
  module.def("use_python", &boule::set_bridge_python);
}
