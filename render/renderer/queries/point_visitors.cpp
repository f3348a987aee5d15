#include "render/renderer/queries/point_visitors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/ray.h"

namespace boule {

void NearestVisitor::start(const Vec3d& point) {
  point_ = point;
  limit_ = most_;
  candidates_.clear();
  upper_.clear();
}

void NearestVisitor::add(const RoughDistance& rough, const Shape& shape, std::int32_t id) {
  candidates_.push_back({rough.value - rough.error, id, shape});
  const double upper = rough.value + rough.error;
  if (upper_.size() == k_) {
    if (upper >= upper_.front()) return;
    std::pop_heap(upper_.begin(), upper_.end());
    upper_.pop_back();
  }
  upper_.push_back(upper);
  std::push_heap(upper_.begin(), upper_.end());
  if (upper_.size() == k_) limit_ = std::min(limit_, upper_.front());
}

void NearestVisitor::finish(double* distance, std::int32_t* id) {
  found_.clear();
  for (const Candidate& one : candidates_) {
    if (one.least > limit_) continue;
    const double exact =
        std::visit([this](const auto& shape) { return find_distance(shape, point_); }, one.shape);
    if (exact > most_) continue;
    const auto holds = [this](const auto& shape) { return is_within(shape, point_, most_); };
    if (exact == most_ && !std::visit(holds, one.shape)) continue;
    found_.emplace_back(exact, one.id);
  }
  std::sort(found_.begin(), found_.end());
  const std::size_t count = std::min(k_, found_.size());
  for (std::size_t i = 0; i < count; ++i) {
    distance[i] = found_[i].first;
    id[i] = found_[i].second;
  }
  std::fill(distance + count, distance + k_, std::numeric_limits<double>::infinity());
  std::fill(id + count, id + k_, no_primitive);
}

const std::vector<std::int32_t>& MemberVisitor::finish() {
  std::sort(ids_.begin(), ids_.end());
  return ids_;
}

}  // namespace boule
