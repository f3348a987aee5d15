#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace boule::python {

/// The fields of every struct of the scene, from their one list: kind ("material", "camera", ...)
/// to type ("plastic", ...) to a list of tuples (key, default or None, whether a file holds it).
pybind11::dict list_fields();

/// Reads a table as the reader of scene files does, to find what is wrong with it, and returns its
/// values as plain ones of Python. `kind` is as in list_fields(), or "particles". `array` is the
/// name of the argument that may have an array in place of "file", or empty: errors are about it
/// then.
pybind11::dict check_table(const std::string& kind, const pybind11::dict& table,
                           const std::string& array);

void bind_tables(pybind11::module_& module);

}  // namespace boule::python
