#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// An option of a class whose objects only calls of the package make. Python's __new__() is a
/// TypeError: the object would have no value, and whoever reads it would read memory at random.
inline pybind11::custom_type_setup made_by_calls() {
  return pybind11::custom_type_setup([](PyHeapTypeObject* type) {
    type->ht_type.tp_new = [](PyTypeObject* made, PyObject* /*arguments*/,
                              PyObject* /*keywords*/) -> PyObject* {
      PyErr_Format(PyExc_TypeError, "cannot create '%.100s' objects", made->tp_name);
      return nullptr;
    };
  });
}

}  // namespace boule::python
