#pragma once

#include <pybind11/pybind11.h>

/// What the module is made of, besides what the headers of the rooms have.
namespace boule::python {

/// Makes Data of arrays, and arrays of Data.
void bind_data(pybind11::module_& module);
/// Makes Data of arrays that hold particles.
void bind_particle_arrays(pybind11::module_& module);
/// Makes Data of arrays of capsules, and arrays of these.
void bind_capsule_arrays(pybind11::module_& module);
/// Makes Tracer and Hits.
void bind_tracing(pybind11::module_& module);
/// The camera of a scene: its rays, and the numbers of a fitted one.
void bind_camera_rays(pybind11::module_& module);
/// Makes render().
void bind_rendering(pybind11::module_& module);
/// Data and pictures as plain values of Python, and back: boule/_pickling.py pickles these.
void bind_pickling(pybind11::module_& module);

}  // namespace boule::python
