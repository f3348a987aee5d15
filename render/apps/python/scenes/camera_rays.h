#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// The camera of a scene: its rays, and the numbers of a fitted one.
void bind_camera_rays(pybind11::module_& module);

}  // namespace boule::python
