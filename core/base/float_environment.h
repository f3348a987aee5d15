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

/// The same for a few hundred nanoseconds of work without long double, which other functions of the
/// processor than the rest compute: much faster, where the processor allows.
class BriefFloatEnvironment {
#if defined(__SSE2__) && defined(__x86_64__)
 public:
  BriefFloatEnvironment() : saved_(__builtin_ia32_stmxcsr()) {
    constexpr unsigned defaults = 0x1f80;
    __builtin_ia32_ldmxcsr(defaults);
  }
  ~BriefFloatEnvironment() { __builtin_ia32_ldmxcsr(saved_); }
  BriefFloatEnvironment(const BriefFloatEnvironment&) = delete;
  BriefFloatEnvironment& operator=(const BriefFloatEnvironment&) = delete;

 private:
  unsigned saved_;
#else
  FloatEnvironment whole_;
#endif
};

}  // namespace boule
