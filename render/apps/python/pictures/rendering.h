#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// Makes render().
void bind_rendering(pybind11::module_& module);

}  // namespace boule::python
