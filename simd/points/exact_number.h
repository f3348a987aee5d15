#pragma once

#include <cstdint>
#include <vector>

namespace boule {

/// A sum of products of doubles without any rounding, of any size: slow, for what rounding cannot
/// decide. Throws std::bad_alloc.
class ExactNumber {
 public:
  ExactNumber() = default;
  /// Precondition: a finite number.
  ExactNumber(double x);

  /// -1, 0 or 1.
  [[nodiscard]] int sign() const;

  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b);

 private:
  using Digits = std::vector<std::uint32_t>;

  void drop_zeros();
  [[nodiscard]] Digits digits_from(int exponent) const;

  bool negative_ = false;
  int exponent_ = 0;  ///< of the first digit, which counts 2^(32 exponent_)
  Digits digits_;     ///< the lowest first, the highest not 0; empty: 0
};

}  // namespace boule
