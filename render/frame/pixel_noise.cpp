#include "render/frame/pixel_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/math/coverage.h"
#include "core/math/srgb.h"

namespace boule {
namespace {

/// Upper bounds of the sRGB curve's slope: slope_from[k] from 2^-k on, for linear values up to 1.
/// They are 1.055 / 2.4 * 2^(k * 1.4 / 2.4), rounded up, and the slope of the straight piece.
constexpr std::array slope_from{0.4396, 0.6587, 0.9869, 1.479, 2.216, 3.320, 4.975, 7.453, 11.17};
constexpr double steepest = 12.92;

double most_slope_from(double value) {
  if (!(value >= std::ldexp(1.0, 1 - static_cast<int>(slope_from.size())))) return steepest;
  return slope_from[static_cast<std::size_t>(-std::ilogb(std::min(value, 1.0)))];
}

}  // namespace

void SampleHalf::add(const Color& sample, std::uint8_t covered) {
  if (batches() == most_batches) {
    for (std::size_t i = 0; i < least_batches; ++i) {
      for (std::size_t c = 0; c < 4; ++c) sums_[i][c] = sums_[2 * i][c] + sums_[2 * i + 1][c];
    }
    std::fill(sums_.begin() + least_batches, sums_.end(), std::array<float, 4>{});
    ++doublings_;
  }
  auto& sum = sums_[static_cast<std::size_t>(batches())];
  const auto add_to = [&](std::size_t c, float number) {
    sum[c] += number;
    total_[c] += static_cast<double>(number);
  };
  add_to(0, sample.r);
  add_to(1, sample.g);
  add_to(2, sample.b);
  add_to(3, static_cast<float>(covered) / float{whole_coverage});
  ++count_;
}

PixelNumbers SampleHalf::mean() const {
  PixelNumbers mean = total_;
  for (double& number : mean) number /= count_;
  return mean;
}

PixelNumbers SampleHalf::variance() const {
  const auto batches = static_cast<std::size_t>(this->batches());
  PixelNumbers mean{}, squares{};
  for (std::size_t i = 0; i < batches; ++i) {
    for (std::size_t c = 0; c < 4; ++c) mean[c] += static_cast<double>(sums_[i][c]);
  }
  for (double& number : mean) number /= static_cast<double>(batches);
  for (std::size_t i = 0; i < batches; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const double difference = static_cast<double>(sums_[i][c]) - mean[c];
      squares[c] += difference * difference;
    }
  }
  const int length = 1 << doublings_;
  for (double& sum : squares) {
    sum = sum / static_cast<double>(batches - 1) / length;
    if (!(sum >= 0)) sum = std::numeric_limits<double>::infinity();
  }
  return squares;
}

double student_quantile(int degrees) {
  constexpr std::array<double, 30> exact{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                         2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                         2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                         2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
  constexpr double normal = 1.959964, slope = 2.37227;  // of Cornish and Fisher's series
  if (degrees > static_cast<int>(exact.size())) return normal + slope / degrees;
  return exact[static_cast<std::size_t>(std::max(degrees, 1) - 1)];
}

double displayed_half_width(double value, double half_width) {
  if (!(half_width > 0) || value - half_width >= 1) return 0;
  const double middle = srgb_displayed(value), below = middle - srgb_displayed(value - half_width);
  // The curve is steeper on the dark side, so that part is the longer one unless black cuts it off.
  return value >= half_width ? below : std::max(below, srgb_displayed(value + half_width) - middle);
}

double most_displayed_half_width(double value, double half_width) {
  return half_width * most_slope_from(value - half_width);
}

int next_look(int count) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(count) + 1));
}

}  // namespace boule
