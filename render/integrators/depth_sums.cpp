#include "render/integrators/depth_sums.h"

#include <algorithm>
#include <utility>

namespace boule {

void DepthSums::start(std::size_t samples) {
  samples_ = samples;
  first_depth_ = 0;
  for (auto& row : rows_) spare_.push_back(std::move(row));
  rows_.clear();
  total_.assign(samples, Color{});
}

Color* DepthSums::at_depth(int depth) {
  const auto row = static_cast<std::size_t>(depth - first_depth_);
  while (rows_.size() <= row) {
    if (spare_.empty()) {
      rows_.emplace_back();
    } else {
      rows_.push_back(std::move(spare_.back()));
      spare_.pop_back();
    }
    rows_.back().assign(samples_, Color{});
  }
  return rows_[row].data();
}

void DepthSums::finish_below(int depth) {
  const auto wanted = static_cast<std::size_t>(depth - first_depth_);
  const std::size_t finished = std::min(wanted, rows_.size());
  for (std::size_t row = 0; row < finished; ++row) {
    for (std::size_t k = 0; k < samples_; ++k) total_[k] = total_[k] + rows_[row][k];
    spare_.push_back(std::move(rows_[row]));
  }
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(finished));
  first_depth_ = depth;
}

void DepthSums::finish(Color* radiance) {
  finish_below(first_depth_ + static_cast<int>(rows_.size()));
  for (std::size_t k = 0; k < samples_; ++k) radiance[k] = settled(total_[k], faults_);
}

}  // namespace boule
