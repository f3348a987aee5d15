#pragma once

#include <cfenv>

namespace boule {

/// While it lives, the thread computes as IEEE 754 says by default: it rounds to nearest, keeps
/// denormals and traps nothing. Afterwards everything is as the caller had it, the raised
/// exceptions too. So the bits are the same whatever the host application has set.
///
/// Functions of render that read, prepare, render, trace or write make one of their own and call
/// callbacks in it. Core and simd compute as their caller does: a caller who has changed the
/// environment makes one around them.
class FloatEnvironment {
 public:
  FloatEnvironment() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatEnvironment() { std::fesetenv(&saved_); }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace boule
