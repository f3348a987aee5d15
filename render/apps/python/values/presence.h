#pragma once

#include <pybind11/pybind11.h>

namespace boule::python {

/// A thread that is inside a call of the package. An interpreter that ends unwinds the threads that
/// want its GIL, and C++ cannot be unwound that way: the end waits until nobody is inside, and
/// nobody gets in after it.
class Presence {
 public:
  /// Needs the GIL. Throws Python's SystemExit where the interpreter ends.
  Presence();
  ~Presence();
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;

  /// For threads without the GIL: false, without entering, where the interpreter ends. leave()
  /// follows.
  static bool enter();
  static void leave();

  /// True once the interpreter ends, but on the thread that ends it.
  static bool is_over();
  /// Lets nobody in any more, but for the calling thread, which ends the interpreter.
  static void close();
  /// How many are inside.
  static int count();
  /// In a forked process, where none of the other threads are.
  static void forget();
};

/// For every function of the module that releases the GIL or runs code of Python.
using inside = pybind11::call_guard<Presence>;

}  // namespace boule::python
