#pragma once

#include <cfenv>

namespace boule {

/// While it lives, the thread computes as IEEE 754 says by default: to nearest, denormals kept, no
/// traps. Afterwards everything is as the caller had it, raised exceptions too. Same bits whatever
/// the host application has set.
///
/// What reads, prepares, renders, traces or writes (render) makes one of its own, callbacks are
/// called in it. The plain values, builders and kernels below (core, simd) compute as their caller
/// does: who uses them and has changed anything makes one around them.
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
