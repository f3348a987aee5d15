#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// Makes Data of arrays that hold particles.
void bind_particle_arrays(pybind11::module_& module);

}  // namespace boule::python
