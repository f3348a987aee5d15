#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "core/base/error.h"

namespace boule::python {

/// Makes `Error`, a ValueError with file, line, column and key.
void bind_errors(pybind11::module_& module);

/// Throws a Diagnostic as Python's exception: MemoryError if it is about memory, else Error. An
/// option of the command line ("--color") is named as the argument that it is ("color"). Needs the
/// GIL, as all functions here.
[[noreturn]] void throw_error(const Diagnostic& error);

/// Throws an Error about an argument: "KEY: MESSAGE".
[[noreturn]] void throw_error(const std::string& key, const std::string& message);

/// The name of an object's type, for what came in place of what was expected.
std::string type_name(const pybind11::handle& object);

/// The value, or the exception of its Diagnostic.
template <class T>
T take(Result<T> result) {
  if (!result) throw_error(result.error());
  return std::move(result).value();
}

inline void check(const Status& status) {
  if (!status) throw_error(status.error());
}

}  // namespace boule::python
