#pragma once

#include <pybind11/pybind11.h>

#include "render/apps/python/queries/shared_tracer.h"

namespace boule::python {

/// What is asked about points.
void bind_points(pybind11::class_<SharedTracer, TracerHandle>& tracer);

}  // namespace boule::python
