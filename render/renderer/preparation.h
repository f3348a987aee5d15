#pragma once

#include <new>
#include <string>

#include "core/base/error.h"
#include "core/base/float_environment.h"
#include "render/frame/scheduler.h"
#include "simd/abi/kernel_table.h"
#include "simd/dispatch/dispatch.h"

namespace boule {

/// The kernels for options that name this ISA and solver; solver reference has a table of its own.
inline Result<const KernelTable*> kernels_for(const std::string& isa, Solver solver) {
  Result<const KernelTable*> selected = select_kernels(isa);
  if (selected && solver == Solver::reference) return &reference_kernels();
  return selected;
}

/// Calls `prepare`, which returns a Result, and turns its exceptions into Diagnostics.
template <class Prepare>
auto guard_preparation(const Prepare& prepare) -> decltype(prepare()) {
  const FloatEnvironment environment;
  try {
    return prepare();
  } catch (const std::bad_alloc&) {
    return Diagnostic::out_of_memory("out of memory while preparing the scene");
  } catch (...) {  // an exception from copying a callback
    return diagnose([] { throw; }).error();
  }
}

}  // namespace boule
