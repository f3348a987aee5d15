#include "render/frame/pixel_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/math/srgb.h"

namespace boule {

void SampleHalf::add(const Color& sample, std::uint8_t covered) {
  if (count_ == most_batches * length_) {
    for (std::size_t i = 0; i < least_batches; ++i) {
      for (std::size_t c = 0; c < 4; ++c) sums_[i][c] = sums_[2 * i][c] + sums_[2 * i + 1][c];
    }
    std::fill(sums_.begin() + least_batches, sums_.end(), std::array<float, 4>{});
    length_ *= 2;
  }
  const std::array<float, 4> numbers{sample.r, sample.g, sample.b, static_cast<float>(covered)};
  auto& sum = sums_[static_cast<std::size_t>(count_ / length_)];
  for (std::size_t c = 0; c < 4; ++c) {
    sum[c] += numbers[c];
    total_[c] += static_cast<double>(numbers[c]);
  }
  ++count_;
}

PixelNumbers SampleHalf::mean() const {
  PixelNumbers mean = total_;
  for (double& number : mean) number /= count_;
  return mean;
}

PixelNumbers SampleHalf::variance() const {
  const auto batches = static_cast<std::size_t>(this->batches());
  PixelNumbers variance{};
  for (std::size_t c = 0; c < 4; ++c) {
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < batches; ++i) sum += static_cast<double>(sums_[i][c]);
    const double mean = sum / static_cast<double>(batches);
    for (std::size_t i = 0; i < batches; ++i) {
      const double difference = static_cast<double>(sums_[i][c]) - mean;
      squares += difference * difference;
    }
    variance[c] = squares / static_cast<double>(batches - 1) / length_;
  }
  return variance;
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

int next_look(int count) {
  const int octave = std::bit_width(static_cast<unsigned>(count)) - 1;
  return count + (1 << (octave - 2));
}

}  // namespace boule
