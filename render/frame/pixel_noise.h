#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/math/color.h"

namespace boule {

/// The target for a picture's noise. Each pixel gets samples until the half-width of its 95 %
/// confidence interval is expected to be at most `half_width` in each channel as displayed:
/// multiplied by 2^exposure_stops, clamped to 0..1 and with the sRGB curve. Alpha, which has no
/// curve, counts in pictures that have it.
struct NoiseTarget {
  float half_width = 0;  ///< 0..1; 0: no target, all pixels get the same number of samples
  int min_spp = 32;      ///< smallest number of samples of a pixel, >= 16
  int max_spp = 4096;    ///< largest number, >= min_spp
  float exposure_stops = 0;
  bool alpha = false;
};

/// One number for each of red, green, blue and coverage.
using PixelNumbers = std::array<double, 4>;

/// Half of a pixel's samples: a sequence of its own, whose sums are kept in batches of consecutive
/// samples. When there are 16 batches, they are merged two by two. The samples of an evenly spread
/// sequence differ more than their means do. So the spread of batches measures the error of the
/// mean, while that of single samples would not.
class SampleHalf {
 public:
  static constexpr int least_batches = 8;

  /// Adds the next sample. Precondition: there are fewer than 2^30.
  void add(const Color& sample, std::uint8_t covered);

  [[nodiscard]] int count() const { return count_; }
  /// The number of complete batches; from 8 samples on it is 8 to 16.
  [[nodiscard]] int batches() const { return count_ >> doublings_; }
  /// Precondition: there are samples.
  [[nodiscard]] PixelNumbers mean() const;
  /// Estimates the variance of the mean, times the number of samples; infinity if a batch's sum
  /// exceeds the range of floats. Precondition: there are two batches.
  [[nodiscard]] PixelNumbers variance() const;

 private:
  static constexpr int most_batches = 2 * least_batches;

  std::array<std::array<float, 4>, most_batches> sums_{};
  PixelNumbers total_{};
  int count_ = 0;
  int doublings_ = 0;  ///< a batch has 2^doublings samples
};

/// The 0.975 quantile of Student's t distribution, for any degrees of freedom from 1 on.
double student_quantile(int degrees);

/// The displayed half-width of an interval about a linear value: the longer of its two parts in
/// displayed values, 0..1. Preconditions: both arguments are at least 0.
double displayed_half_width(double value, double half_width);

/// An upper bound of displayed_half_width() by the slope of the curve alone, without a power. It is
/// at most 1.53 times the exact value if `value` is at most 1 and the half-width at most a
/// hundredth of it.
double most_displayed_half_width(double value, double half_width);

/// The number of samples after `count` at which a half is judged again: the next power of two,
/// because the points of a Sobol sequence are spread evenly there. Precondition: 0 <= count < 2^30.
int next_look(int count);

}  // namespace boule
