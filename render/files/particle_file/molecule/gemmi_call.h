#pragma once

#include <exception>
#include <new>

#include "core/base/error.h"

namespace boule {

/// Calls what may throw gemmi's exceptions. std::bad_alloc goes on.
template <class Call>
Status call_gemmi(const Call& call) {
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return Diagnostic::of(error.what());
  }
}

}  // namespace boule
