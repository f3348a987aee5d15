#include "render/integrators/depth_sums.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace boule {

/// By memset(), because assign() stores number by number.
void DepthSums::clear(std::vector<ColorSum>& row) const {
  row.resize(samples_);
  if (samples_ > 0) std::memset(row.data(), 0, samples_ * sizeof(ColorSum));
}

void DepthSums::start(std::size_t samples) {
  samples_ = samples;
  first_depth_ = 0;
  for (auto& row : rows_) spare_.push_back(std::move(row));
  rows_.clear();
  clear(total_);
}

ColorSum* DepthSums::at_depth(int depth) {
  if (rays_ == RaysPerDepth::one_at_most) return total_.data();
  const auto row = static_cast<std::size_t>(depth - first_depth_);
  while (rows_.size() <= row) {
    if (spare_.empty()) {
      rows_.emplace_back();
    } else {
      rows_.push_back(std::move(spare_.back()));
      spare_.pop_back();
    }
    clear(rows_.back());
  }
  return rows_[row].data();
}

void DepthSums::finish_below(int depth) {
  const auto wanted = static_cast<std::size_t>(depth - first_depth_);
  const std::size_t finished = std::min(wanted, rows_.size());
  for (std::size_t row = 0; row < finished; ++row) {
    const ColorSum* const sums = rows_[row].data();
    for (std::size_t k = 0; k < samples_; ++k) {
      for (std::size_t c = 0; c < 4; ++c) total_[k].rgb0[c] += sums[k].rgb0[c];
    }
    spare_.push_back(std::move(rows_[row]));
  }
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(finished));
  first_depth_ = depth;
}

void DepthSums::finish(Color* radiance) {
  finish_below(first_depth_ + static_cast<int>(rows_.size()));
  for (std::size_t k = 0; k < samples_; ++k) {
    const float* const sum = total_[k].rgb0;
    radiance[k] = settled({sum[0], sum[1], sum[2]}, faults_);
  }
}

}  // namespace boule
