#pragma once

#include <cfenv>

namespace boule {

/// During its lifetime, the thread computes by the defaults of IEEE 754: it rounds to nearest,
/// keeps denormals and masks all exceptions. Its destructor restores the caller's environment,
/// raised exceptions included. So the bits are the same whatever the host application has set.
///
/// Functions of render that read, prepare, render, trace or write make their own and call callbacks
/// in it. Core and simd compute in the caller's environment: if you have changed it, put a
/// FloatEnvironment around the calls.
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
