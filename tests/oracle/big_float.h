#pragma once

#include <mpfr.h>

namespace boule::test {

/// A number of 1400 bits, by MPFR, rounding to nearest: products and sums of a few floats of any
/// size are exact, and so are the signs that decide a hit.
class BigFloat {
 public:
  static constexpr mpfr_prec_t bits = 1400;

  BigFloat() { mpfr_init2(value_, bits); }
  BigFloat(double x) : BigFloat() { mpfr_set_d(value_, x, MPFR_RNDN); }
  BigFloat(const BigFloat& other) : BigFloat() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  BigFloat& operator=(const BigFloat& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~BigFloat() { mpfr_clear(value_); }

  friend BigFloat operator+(const BigFloat& a, const BigFloat& b) { return apply(mpfr_add, a, b); }
  friend BigFloat operator-(const BigFloat& a, const BigFloat& b) { return apply(mpfr_sub, a, b); }
  friend BigFloat operator*(const BigFloat& a, const BigFloat& b) { return apply(mpfr_mul, a, b); }
  friend BigFloat operator/(const BigFloat& a, const BigFloat& b) { return apply(mpfr_div, a, b); }
  friend BigFloat sqrt(const BigFloat& a) {
    BigFloat out;
    mpfr_sqrt(out.value_, a.value_, MPFR_RNDN);
    return out;
  }
  friend BigFloat abs(const BigFloat& a) {
    BigFloat out;
    mpfr_abs(out.value_, a.value_, MPFR_RNDN);
    return out;
  }
  friend bool operator<(const BigFloat& a, const BigFloat& b) {
    return mpfr_less_p(a.value_, b.value_) != 0;
  }
  friend bool operator<=(const BigFloat& a, const BigFloat& b) {
    return mpfr_lessequal_p(a.value_, b.value_) != 0;
  }

  /// -1, 0 or 1.
  [[nodiscard]] int sign() const {
    return mpfr_sgn(value_) > 0 ? 1 : mpfr_sgn(value_) < 0 ? -1 : 0;
  }
  /// Rounded to nearest.
  [[nodiscard]] double to_double() const { return mpfr_get_d(value_, MPFR_RNDN); }

 private:
  using Operation = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
  static BigFloat apply(Operation operation, const BigFloat& a, const BigFloat& b) {
    BigFloat out;
    operation(out.value_, a.value_, b.value_, MPFR_RNDN);
    return out;
  }

  mpfr_t value_;
};

}  // namespace boule::test
