#include "render/renderer/noise_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/elementary.h"

namespace boule {
namespace {

/// The weight of the variance around a pixel, in samples of the pixel's own.
constexpr double samples_around = 32;

float as_float(double number) {
  constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
  return static_cast<float>(std::min(number, largest));
}

}  // namespace

NoiseBlock::NoiseBlock(const NoiseTarget& target)
    : target_(target),
      scale_(elementary::pow(2, static_cast<double>(target.exposure_stops))),
      order_(block_pixels(largest + 2 * rim)) {}

void NoiseBlock::begin(const PixelRect& block, const PixelRect& frame) {
  block_ = block;
  area_ = {std::max(block.x0 - rim, frame.x0), std::max(block.y0 - rim, frame.y0),
           std::min(block.x1 + rim, frame.x1), std::min(block.y1 + rim, frame.y1)};
  states_.assign(static_cast<std::size_t>(area_.area()), {});
  unsettled_.clear();
  wanted_.clear();
  for (const PixelOffset& offset : order_) {
    const int x = area_.x0 + offset.x, y = area_.y0 + offset.y;
    if (x >= area_.x1 || y >= area_.y1) continue;
    unsettled_.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
    wanted_.push_back({x, y});
    wanted_.push_back({x + half_distance, y});
  }
  first_ = 0;
  end_ = target_.min_spp / 2;
}

bool NoiseBlock::look(MeasuredPicture& picture) {
  find_variances();
  if (first_ == 0) look_around();
  settled_ = {};
  wanted_.clear();
  const std::uint32_t most = most_samples(target_.max_spp);
  const auto is_done = [&](const Pixel& pixel) {
    State& state = at(pixel.x, pixel.y);
    if (!settle(state)) {
      want_more(pixel);
      return false;
    }
    const MeasuredPixel& done = picture.at(pixel.x, pixel.y) = measured(state);
    settled_.add(done.samples, most);
    return true;
  };
  unsettled_.erase(std::remove_if(unsettled_.begin(), unsettled_.end(), is_done), unsettled_.end());
  first_ = end_;
  end_ = std::min(next_look(end_), target_.max_spp / 2);
  return !unsettled_.empty();
}

/// Of the halves that got samples.
void NoiseBlock::find_variances() {
  for (const Half& one : wanted_) {
    State& state = at(column(one.x), one.y);
    const std::size_t half = half_of(one.x);
    state.variances[half] = state.halves[half].variance();
  }
}

/// The rim's pixels are done once their variance is known.
void NoiseBlock::look_around() {
  for (int y = block_.y0; y < block_.y1; ++y) {
    for (int x = block_.x0; x < block_.x1; ++x) at(x, y).around = variance_around(x, y);
  }
  const auto is_of_rim = [this](const Pixel& p) {
    return p.x < block_.x0 || p.x >= block_.x1 || p.y < block_.y0 || p.y >= block_.y1;
  };
  unsettled_.erase(std::remove_if(unsettled_.begin(), unsettled_.end(), is_of_rim),
                   unsettled_.end());
}

PixelNumbers NoiseBlock::variance_around(int x, int y) {
  PixelNumbers sum{};
  int halves = 0;
  for (int at_y = std::max(y - rim, area_.y0); at_y < std::min(y + rim + 1, area_.y1); ++at_y) {
    for (int at_x = std::max(x - rim, area_.x0); at_x < std::min(x + rim + 1, area_.x1); ++at_x) {
      if (at_x == x && at_y == y) continue;
      for (const PixelNumbers& variance : at(at_x, at_y).variances) {
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += variance[c];
        ++halves;
      }
    }
  }
  for (double& number : sum) number /= std::max(halves, 1);
  return sum;
}

/// The variance that a half measures or, if that is more, the same together with a few samples of
/// the pixels around. So a pixel whose first samples all miss a rare event continues long enough.
PixelNumbers NoiseBlock::careful_variance(const State& state, std::size_t half) const {
  const double count = state.halves[half].count();
  PixelNumbers variance = state.variances[half];
  for (std::size_t c = 0; c < variance.size(); ++c) {
    const double with_others =
        (count * variance[c] + samples_around * state.around[c]) / (count + samples_around);
    variance[c] = std::max(variance[c], with_others);
  }
  return variance;
}

/// The greatest displayed half-width of the channels, or `least` if that is more.
double NoiseBlock::displayed(const PixelNumbers& mean, const PixelNumbers& half_width,
                             double least) const {
  double greatest = target_.alpha ? std::max(least, half_width[3]) : least;
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = mean[c] * scale_, width = half_width[c] * scale_;
    if (most_displayed_half_width(value, width) > greatest)
      greatest = std::max(greatest, displayed_half_width(value, width));
  }
  return greatest;
}

/// Whether a half judges that the pixel has enough with this many samples in both halves.
bool NoiseBlock::is_enough(const State& state, std::size_t half, int count) const {
  const SampleHalf& samples = state.halves[half];
  const double factor = student_quantile(2 * (samples.batches() - 1));  // of two such halves
  const auto most = static_cast<double>(target_.half_width);
  PixelNumbers half_width = careful_variance(state, half);
  for (double& number : half_width) number = factor * std::sqrt(number / (2 * count));
  return displayed(samples.mean(), half_width, most) <= most;
}

/// The number of samples for the other half, as this half decides: as many as it has itself, or the
/// next number, or 0 to decide again with more samples of its own. (To decide again for the next
/// number would be safer, but costs samples that only decide: 10 % of all in soft_light.)
int NoiseBlock::decide(const State& state, std::size_t half) const {
  const int most = target_.max_spp / 2, count = state.halves[half].count(),
            next = std::min(next_look(count), most);
  if (count == most || is_enough(state, half, count)) return count;
  return next == most || is_enough(state, half, next) ? next : 0;
}

/// Decides the halves' numbers of samples, and settles the halves that have them. True if both
/// have.
bool NoiseBlock::settle(State& state) const {
  for (std::size_t half = 0; half < 2; ++half) {
    if (state.goals[half] == 0) state.goals[half] = decide(state, 1 - half);
    const SampleHalf& samples = state.halves[half];
    if (samples.count() == state.goals[half]) {
      state.settled[half] = {samples.mean(), careful_variance(state, half), samples.count(),
                             samples.batches()};
    }
  }
  return state.settled[0].count > 0 && state.settled[1].count > 0;
}

/// Requests samples for the halves of a pixel that need more, and for those that decide for the
/// other half.
void NoiseBlock::want_more(const Pixel& pixel) {
  const State& state = at(pixel.x, pixel.y);
  for (std::size_t half = 0; half < 2; ++half) {
    if (state.settled[half].count > 0 && state.goals[1 - half] > 0) continue;
    wanted_.push_back({pixel.x + (half == 0 ? 0 : half_distance), pixel.y});
  }
}

MeasuredPixel NoiseBlock::measured(const State& state) const {
  const auto& [a, b] = state.settled;
  const double factor = student_quantile(a.batches + b.batches - 2);
  PixelNumbers mean{}, half_width{};
  for (std::size_t c = 0; c < mean.size(); ++c) {
    mean[c] = (a.mean[c] + b.mean[c]) / 2;
    const double variance = (a.variance[c] + b.variance[c]) / 2;
    half_width[c] = factor * std::sqrt(variance * (1.0 / a.count + 1.0 / b.count)) / 2;
  }
  return {{as_float(mean[0]), as_float(mean[1]), as_float(mean[2])},
          as_float(mean[3]),
          static_cast<float>(displayed(mean, half_width, 0) / interval_in_errors),
          static_cast<std::uint32_t>(a.count + b.count)};
}

}  // namespace boule
