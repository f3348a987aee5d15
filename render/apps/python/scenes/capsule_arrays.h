#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// Makes Data of arrays of capsules, and arrays of these.
void bind_capsule_arrays(pybind11::module_& module);

}  // namespace boule::python
