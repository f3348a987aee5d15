#pragma once

#include <cfenv>

namespace boule {

/// While it lives, the thread computes as IEEE 754 says by default: to nearest, denormals kept, no
/// traps. Afterwards everything is as the caller had it. Same bits whatever the host application
/// has set.
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
