#include "render/integrators/depth_sums.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace boule {
namespace {

/// By memset(), because assign() stores number by number.
void clear(std::vector<ColorSum>& row, std::size_t samples) {
  row.resize(samples);
  if (samples > 0) std::memset(row.data(), 0, samples * sizeof(ColorSum));
}

void add(const std::vector<ColorSum>& row, std::size_t samples, std::vector<ColorSum>& total) {
  for (std::size_t k = 0; k < samples; ++k) {
    for (std::size_t c = 0; c < 4; ++c) total[k].rgb0[c] += row[k].rgb0[c];
  }
}

}  // namespace

void DepthSums::start(std::size_t samples) {
  while (!rows_.empty()) {
    spare_.push_back(std::move(rows_.back()));
    rows_.pop_back();
  }
  has_total_ = rays_ == RaysPerDepth::one_at_most;
  if (has_total_) clear(total_, samples);
  samples_ = samples;
  first_depth_ = 0;
}

ColorSum* DepthSums::at_depth(int depth) {
  if (rays_ == RaysPerDepth::one_at_most) return total_.data();
  const auto row = static_cast<std::size_t>(depth - first_depth_);
  while (rows_.size() <= row) {
    std::vector<ColorSum> next;
    if (!spare_.empty()) {
      next = std::move(spare_.back());
      spare_.pop_back();
    }
    clear(next, samples_);
    rows_.push_back(std::move(next));
  }
  return rows_[row].data();
}

void DepthSums::finish_below(int depth) {
  const auto wanted = static_cast<std::size_t>(depth - first_depth_);
  const std::size_t finished = std::min(wanted, rows_.size());
  for (std::size_t row = 0; row < finished; ++row) {
    if (has_total_) {
      add(rows_[row], samples_, total_);
    } else {
      std::swap(total_, rows_[row]);
      has_total_ = true;
    }
    spare_.push_back(std::move(rows_[row]));
  }
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(finished));
  first_depth_ = depth;
}

void DepthSums::finish(Color* radiance) {
  finish_below(first_depth_ + static_cast<int>(rows_.size()));
  if (!has_total_) clear(total_, samples_);
  for (std::size_t k = 0; k < samples_; ++k) {
    const float* const sum = total_[k].rgb0;
    radiance[k] = settled({sum[0], sum[1], sum[2]}, faults_);
  }
}

}  // namespace boule
