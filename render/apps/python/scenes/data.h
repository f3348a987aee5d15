#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// Makes Data of arrays, and arrays of Data.
void bind_data(pybind11::module_& module);

}  // namespace boule::python
