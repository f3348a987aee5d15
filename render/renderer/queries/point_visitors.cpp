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

BlockBounds block_bounds(const SphereBlock& spheres) {
  Vec3d sum{};
  double count = 0, radius = 0;
  for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
    if (std::isnan(spheres.radius[k])) continue;
    sum = sum + vec_cast<double>(ball_in(spheres, k).center);
    count += 1;
  }
  const Vec3d middle = sum * (1 / count);
  for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
    if (std::isnan(spheres.radius[k])) continue;
    const Ball ball = ball_in(spheres, k);
    const Vec3d way = vec_cast<double>(ball.center) - middle;
    radius = std::max(radius, std::sqrt(dot(way, way)) + double{ball.radius});
  }
  return {middle, count > 0 ? radius : std::numeric_limits<double>::quiet_NaN()};
}

/// The distance within which the pairs of something with this radius are.
double PairFinder::limit_of(double radius) const {
  constexpr double share = 0x1p-45;  // for rounding
  return radius + gap_ + share * (radius + std::fabs(gap_));
}

/// Finds the blocks, from this one on, with spheres that may be near one of this block.
void PairFinder::gather(std::size_t block) {
  const auto [middle, radius] = bounds_[block];
  near_.clear();
  blocks_.visit_near(
      middle, [limit = limit_of(radius)] { return limit; },
      [&](std::size_t index) {
        if (index >= block) near_.push_back({index, blocks_.at(index)});
      });
}

void PairFinder::find(std::size_t block, std::vector<SpherePair>& pairs) {
  if (std::isnan(bounds_[block].radius)) return;
  const PlacedBlock own = blocks_.at(block);
  const SphereBlock& spheres = own.spheres();
  gather(block);
  for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
    if (std::isnan(spheres.radius[k])) continue;
    const Ball ball = ball_in(spheres, k);
    for (const Near& near : near_) {
      const auto& [middle, radius] = bounds_[near.index];
      const Vec3d way = vec_cast<double>(ball.center) - middle;
      const double reach = limit_of(double{ball.radius} + radius);
      if (reach >= 0 && dot(way, way) <= reach * reach)
        pair_up(ball, own.id(k), near, near.index == block ? k : 0, pairs);
    }
  }
}

/// Pairs a sphere with those of a block, from one slot on. The first slot may be its own: then only
/// copies of it make pairs.
void PairFinder::pair_up(const Ball& ball, std::int32_t id, const Near& near,
                         std::size_t first_slot, std::vector<SpherePair>& pairs) {
  const Vec3d point = vec_cast<double>(ball.center);
  const SphereBlock& block = near.block.spheres();
  const BlockDistances distances(block, point, limit_of(double{ball.radius}));
  for (std::size_t k = first_slot; k < bvh_leaf_size; ++k) {
    if (!distances.may_be_near(k)) continue;
    Ball both = ball_in(block, k);
    both.more = ball.radius;
    if (is_within(both, point, gap_)) add(id, near.block.id(k), find_distance(both, point), pairs);
  }
}

void PairFinder::add(std::int32_t a, std::int32_t b, double gap,
                     std::vector<SpherePair>& pairs) const {
  for_copies(geometry_, a, [&](std::int32_t one) {
    for_copies(geometry_, b, [&](std::int32_t other) {
      const bool is_new = a == b ? one < other : one != other;
      if (is_new) pairs.push_back({std::min(one, other), std::max(one, other), gap});
    });
  });
}

}  // namespace boule
