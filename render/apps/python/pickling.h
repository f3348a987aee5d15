#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// Data and pictures as plain values of Python, and back: boule/_pickling.py pickles these.
void bind_pickling(pybind11::module_& module);

}  // namespace boule::python
