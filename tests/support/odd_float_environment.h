#pragma once

#include <cfenv>
#include <ostream>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace boule::test {

/// What a host application may have done to its thread: another rounding mode, denormals flushed
/// to zero both ways, a trap at every exception, inexact results among them.
enum class Oddity { upward, downward, toward_zero, flushing, trapping };

inline constexpr Oddity oddities[] = {Oddity::upward, Oddity::downward, Oddity::toward_zero,
                                      Oddity::flushing, Oddity::trapping};

inline const char* name_of(Oddity oddity) {
  constexpr const char* names[] = {"upward", "downward", "toward_zero", "flushing", "trapping"};
  return names[static_cast<int>(oddity)];
}
inline std::ostream& operator<<(std::ostream& out, Oddity oddity) { return out << name_of(oddity); }

/// Sets this thread's float environment so for as long as this lives. Only the tested code should
/// compute with floats meanwhile: where exceptions trap, others would end the program.
class OddFloatEnvironment {
 public:
  explicit OddFloatEnvironment(Oddity oddity) {
    std::fegetenv(&saved_);
    std::feclearexcept(FE_ALL_EXCEPT);
    set(oddity);
    odd_ = now();
  }
  ~OddFloatEnvironment() { std::fesetenv(&saved_); }
  OddFloatEnvironment(const OddFloatEnvironment&) = delete;
  OddFloatEnvironment& operator=(const OddFloatEnvironment&) = delete;

  /// Whether the environment is as it was set and no exception was raised.
  [[nodiscard]] bool holds() const { return now() == odd_; }

 private:
  struct Controls {
    int rounding, traps, raised;
    unsigned mxcsr;  ///< flags of denormals, too
    bool operator==(const Controls&) const = default;
  };

  static void set(Oddity oddity) {
    switch (oddity) {
      case Oddity::upward:
        std::fesetround(FE_UPWARD);
        break;
      case Oddity::downward:
        std::fesetround(FE_DOWNWARD);
        break;
      case Oddity::toward_zero:
        std::fesetround(FE_TOWARDZERO);
        break;
      case Oddity::flushing:
#if defined(__SSE__)
        _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
        break;
      case Oddity::trapping:
        feenableexcept(FE_ALL_EXCEPT);
        break;
    }
  }
  static Controls now() {
    Controls controls{std::fegetround(), fegetexcept(), std::fetestexcept(FE_ALL_EXCEPT), 0};
#if defined(__SSE__)
    controls.mxcsr = _mm_getcsr();
#endif
    return controls;
  }

  std::fenv_t saved_;
  Controls odd_{};
};

}  // namespace boule::test
