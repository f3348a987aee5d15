#include "simd/points/exact_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace boule {
namespace {

constexpr int digit_bits = 32;

using Digits = std::vector<std::uint32_t>;

/// Whether a < b. Both have no zeros at the end.
bool is_less(const Digits& a, const Digits& b) {
  if (a.size() != b.size()) return a.size() < b.size();
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

void add_to(Digits& a, const Digits& b) {
  a.resize(std::max(a.size(), b.size()) + 1);
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    carry += std::uint64_t{a[i]} + (i < b.size() ? b[i] : 0);
    a[i] = static_cast<std::uint32_t>(carry);
    carry >>= digit_bits;
  }
}

/// Precondition: a >= b.
void subtract_from(Digits& a, const Digits& b) {
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::uint64_t less = (i < b.size() ? b[i] : 0) + borrow;
    borrow = a[i] < less ? 1 : 0;
    a[i] -= static_cast<std::uint32_t>(less);
  }
}

}  // namespace

ExactNumber::ExactNumber(double x) : negative_(x < 0) {
  constexpr int mantissa_bits = 53;
  int exponent = 0;
  const double mantissa = std::frexp(std::fabs(x), &exponent);
  const auto bits = static_cast<std::uint64_t>(std::ldexp(mantissa, mantissa_bits));
  exponent -= mantissa_bits;
  const int shift = ((exponent % digit_bits) + digit_bits) % digit_bits;
  exponent_ = (exponent - shift) / digit_bits;
  const std::uint64_t low = bits << shift;
  const std::uint64_t high = shift == 0 ? 0 : bits >> (64 - shift);
  digits_ = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> digit_bits),
             static_cast<std::uint32_t>(high)};
  drop_zeros();
}

int ExactNumber::sign() const {
  if (digits_.empty()) return 0;
  return negative_ ? -1 : 1;
}

void ExactNumber::drop_zeros() {
  while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
}

/// The digits, the first of which counts 2^(32 exponent). Precondition: exponent <= exponent_.
ExactNumber::Digits ExactNumber::digits_from(int exponent) const {
  Digits digits(static_cast<std::size_t>(exponent_ - exponent));
  digits.insert(digits.end(), digits_.begin(), digits_.end());
  return digits;
}

ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) {
  if (a.digits_.empty()) return b;
  if (b.digits_.empty()) return a;
  ExactNumber sum;
  sum.exponent_ = std::min(a.exponent_, b.exponent_);
  sum.negative_ = a.negative_;
  sum.digits_ = a.digits_from(sum.exponent_);
  Digits other = b.digits_from(sum.exponent_);
  if (a.negative_ == b.negative_) {
    add_to(sum.digits_, other);
  } else {
    if (is_less(sum.digits_, other)) {
      std::swap(sum.digits_, other);
      sum.negative_ = b.negative_;
    }
    subtract_from(sum.digits_, other);
  }
  sum.drop_zeros();
  return sum;
}

ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber minus = b;
  minus.negative_ = !b.negative_;
  return a + minus;
}

ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
  ExactNumber product;
  product.negative_ = a.negative_ != b.negative_;
  product.exponent_ = a.exponent_ + b.exponent_;
  product.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
  for (std::size_t i = 0; i < a.digits_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.digits_.size(); ++j) {
      carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + product.digits_[i + j];
      product.digits_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= digit_bits;
    }
    product.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
  }
  product.drop_zeros();
  return product;
}

}  // namespace boule
