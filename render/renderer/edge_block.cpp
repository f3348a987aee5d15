#include "render/renderer/edge_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/math/coverage.h"
#include "core/math/elementary.h"
#include "core/math/srgb.h"

namespace boule {
namespace {

/// The least numbers of samples at an edge, at a strong one, and where small spheres may hide.
constexpr int at_edge = 4, at_strong_edge = 8, of_small_spheres = 16;

/// A strong edge, in steps of the target.
constexpr float strong = 4;

/// The largest error of a mean of eight samples, in steps of the target. Of n samples it is
/// (n/8)^(3/4) times that: where samples differ much, errors are seen less, and rays cost more.
constexpr double most_error = 0.3;

/// The error of the mean of n samples, divided by their standard deviation and n^(-3/4). An edge
/// cuts about n^(1/2) of the n cells of a pixel, which have a sample each.
constexpr double spread_to_error = 0.8;

/// x^(3/4)
double three_quarters(double x) { return std::sqrt(x * std::sqrt(x)); }

}  // namespace

EdgeBlock::EdgeBlock(const EdgeTarget& target, const SmallSpheres& small_spheres)
    : target_(target),
      small_spheres_(small_spheres),
      scale_(static_cast<float>(elementary::pow(2, static_cast<double>(target.exposure_stops)))),
      order_(block_pixels(largest + 2 * rim)) {}

void EdgeBlock::begin(const PixelRect& block, const PixelRect& frame) {
  block_ = block;
  area_ = {std::max(block.x0 - rim, frame.x0), std::max(block.y0 - rim, frame.y0),
           std::min(block.x1 + rim, frame.x1), std::min(block.y1 + rim, frame.y1)};
  codes_.resize(static_cast<std::size_t>(area_.area()));
  steps_.resize(static_cast<std::size_t>(block_.area()));
  centers_.resize(static_cast<std::size_t>(block_.area()));
  index_.resize(static_cast<std::size_t>(block_.area()));
  samples_.clear();
  wanted_.clear();
  for (const PixelOffset& offset : order_) {
    const int x = area_.x0 + offset.x, y = area_.y0 + offset.y;
    if (x < area_.x1 && y < area_.y1) wanted_.push_back({x, y});
  }
  first_ = center;
  end_ = center + 1;
}

void EdgeBlock::add(const SampleId& id, const Color& sample, std::uint8_t covered) {
  if (id.sample == center) return add_center(id, sample, covered);
  Samples& samples = samples_[index_[block_.index(id.x, id.y)]];
  const PixelNumbers numbers{static_cast<double>(sample.r), static_cast<double>(sample.g),
                             static_cast<double>(sample.b), covered / double{whole_coverage}};
  for (std::size_t c = 0; c < numbers.size(); ++c) {
    samples.sum[c] += numbers[c];
    samples.squares[c] += numbers[c] * numbers[c];
  }
  ++samples.count;
}

void EdgeBlock::add_center(const SampleId& id, const Color& sample, std::uint8_t covered) {
  const SrgbTable& table = SrgbTable::get();
  const auto code = [&](float number) { return table.code(number * scale_); };
  codes_[area_.index(id.x, id.y)] = {code(sample.r), code(sample.g), code(sample.b), covered};
  if (in_block({id.x, id.y})) centers_[block_.index(id.x, id.y)] = sample;
}

bool EdgeBlock::look(MeasuredPicture& picture) {
  settled_ = {};
  const bool at_centers = first_ == center;
  if (at_centers) find_steps();
  const auto is_done = [&](const Pixel& pixel) {
    return at_centers ? settle_center(pixel, picture) : settle(pixel, picture);
  };
  wanted_.erase(std::remove_if(wanted_.begin(), wanted_.end(), is_done), wanted_.end());
  first_ = end_;
  end_ = std::min(at_centers ? at_edge : 2 * end_, target_.max_spp);
  return !wanted_.empty();
}

void EdgeBlock::find_steps() {
  std::fill(steps_.begin(), steps_.end(), Codes{});
  for (int y = block_.y0; y < block_.y1; ++y) {
    for (int dy = std::max(-rim, area_.y0 - y); dy <= std::min(rim, area_.y1 - 1 - y); ++dy) {
      for (int dx = -rim; dx <= rim; ++dx) widen_steps(y, dx, dy);
    }
  }
}

/// The steps from the pixels of row y to those at this distance. It is a loop over bytes, which
/// compilers turn into one over many of them at a time.
void EdgeBlock::widen_steps(int y, int dx, int dy) {
  const int x0 = std::max(block_.x0, area_.x0 - dx), x1 = std::min(block_.x1, area_.x1 - dx);
  const std::uint8_t* const here = codes_[area_.index(x0, y)].data();
  const std::uint8_t* const there = codes_[area_.index(x0 + dx, y + dy)].data();
  std::uint8_t* const steps = steps_[block_.index(x0, y)].data();
  const std::size_t count = static_cast<std::size_t>(x1 - x0) * std::tuple_size_v<Codes>;
  for (std::size_t i = 0; i < count; ++i) {
    const auto least = std::min(here[i], there[i]), most = std::max(here[i], there[i]);
    steps[i] = std::max(steps[i], static_cast<std::uint8_t>(most - least));
  }
}

/// Sets a pixel whose first sample is enough. True for pixels of the rim, too.
bool EdgeBlock::settle_center(const Pixel& pixel, MeasuredPicture& picture) {
  if (!in_block(pixel)) return true;
  const std::size_t i = block_.index(pixel.x, pixel.y);
  if (const int least = least_samples(pixel); least > 1) {
    index_[i] = static_cast<std::uint32_t>(samples_.size());
    samples_.push_back({.least = least});
    return false;
  }
  const Codes& codes = codes_[area_.index(pixel.x, pixel.y)];
  set(pixel, {centers_[i], static_cast<float>(codes[3]) / float{whole_coverage}, 0, 1}, picture);
  return true;
}

int EdgeBlock::least_samples(const Pixel& pixel) const {
  const Codes& steps = steps_[block_.index(pixel.x, pixel.y)];
  const auto step = static_cast<float>(*std::max_element(steps.begin(), steps.end()));
  if (small_spheres_.may_hide(pixel.x, pixel.y)) return of_small_spheres;
  if (!(step > target_.step)) return 1;
  return step > target_.step * strong ? at_strong_edge : at_edge;
}

/// Sets a pixel whose samples are enough.
bool EdgeBlock::settle(const Pixel& pixel, MeasuredPicture& picture) {
  const Samples& samples = samples_[index_[block_.index(pixel.x, pixel.y)]];
  const double error = error_of(samples);
  const double most =
      static_cast<double>(target_.step) / 255 * most_error * three_quarters(samples.count / 8.0);
  const bool is_enough = samples.count >= samples.least && error <= most;
  if (!is_enough && samples.count < target_.max_spp) return false;
  const auto mean = [&](std::size_t c) {
    constexpr auto largest = static_cast<double>(std::numeric_limits<float>::max());
    return static_cast<float>(std::min(samples.sum[c] / samples.count, largest));
  };
  set(pixel,
      {{mean(0), mean(1), mean(2)},
       mean(3),
       static_cast<float>(error),
       static_cast<std::uint32_t>(samples.count)},
      picture);
  return true;
}

/// An upper bound of the displayed error of the mean, of the channel where it is greatest.
double EdgeBlock::error_of(const Samples& samples) const {
  const double n = samples.count, scale = static_cast<double>(scale_);
  if (samples.count < 2) return 1;
  const double factor = spread_to_error / three_quarters(n);
  const auto error = [&](std::size_t c) {
    const double variance = samples.squares[c] - samples.sum[c] * (samples.sum[c] / n);
    return factor * std::sqrt(std::max(variance, 0.0) / (n - 1));
  };
  double greatest = target_.alpha ? error(3) : 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = samples.sum[c] / n * scale;
    if (value - error(c) * scale >= 1) continue;  // white, whatever it is
    greatest = std::max(greatest, most_displayed_half_width(value, error(c) * scale));
  }
  return std::min(greatest, 1.0);
}

void EdgeBlock::set(const Pixel& pixel, const MeasuredPixel& done, MeasuredPicture& picture) {
  picture.at(pixel.x, pixel.y) = done;
  settled_.add(done.samples, most_samples(target_.max_spp));
}

}  // namespace boule
