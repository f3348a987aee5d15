#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// Makes Tracer and Hits.
void bind_tracing(pybind11::module_& module);

}  // namespace boule::python
