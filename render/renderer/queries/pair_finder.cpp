#include "render/renderer/queries/pair_finder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/math/ray.h"
#include "render/renderer/queries/point_visitors.h"
#include "simd/geometry/bvh_builder.h"

namespace boule {
namespace {

/// How much wider float looks than the gap and the radii, as a share of them.
constexpr float pair_share = 0x1p-20F;

/// The slots of a block that hold spheres.
std::uint32_t filled_slots(const SphereBlock& spheres) {
  std::uint32_t slots = 0;
  for (std::uint32_t k = 0; k < bvh_leaf_size; ++k)
    slots |= std::isnan(spheres.radius[k]) ? 0U : 1U << k;
  return slots;
}

/// The box of the centres in the first slots of a block.
struct CenterBox {
  Vec3f low, high;
  float radius;  ///< the largest
};
CenterBox box_of(const SphereBlock& spheres, std::size_t count) {
  const Ball first = ball_in(spheres, 0);
  CenterBox box{first.center, first.center, first.radius};
  for (std::size_t k = 1; k < count; ++k) {
    const auto& [center, radius, more] = ball_in(spheres, k);
    box.low = {std::min(box.low.x, center.x), std::min(box.low.y, center.y),
               std::min(box.low.z, center.z)};
    box.high = {std::max(box.high.x, center.x), std::max(box.high.y, center.y),
                std::max(box.high.z, center.z)};
    box.radius = std::max(box.radius, radius);
  }
  return box;
}

}  // namespace

PairFinder::PairFinder(const Geometry& geometry, const GeometryView& view, double gap)
    : geometry_(geometry),
      blocks_(view),
      gap_(gap),
      float_gap_(
          float_above(gap > 0 ? gap * (1 + double{pair_share}) : gap * (1 - double{pair_share}))) {}

/// The slots of a block whose spheres may be near something of a radius, if square(k) is the
/// square of its distance from a centre. A slot without a sphere is not near.
template <class Square>
std::uint32_t PairFinder::near_slots(const SphereBlock& spheres, float radius,
                                     const Square& square) const {
  constexpr float least = std::numeric_limits<float>::min();
  std::uint32_t near = 0;
  for (std::size_t k = 0; k < bvh_leaf_size; ++k) {
    const float reach = (std::fabs(spheres.radius[k]) + radius) * (1 + pair_share) + float_gap_;
    near |= square(k) <= reach * std::fabs(reach) + least ? 1U << k : 0U;
  }
  return near;
}

void PairFinder::take(const PlacedBlock& block, std::uint32_t slots) {
  const SphereBlock& from = block.spheres();
  for (; slots != 0; slots &= slots - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(slots));
    const std::size_t at = candidates_.ids.size() % bvh_leaf_size;
    if (at == 0) candidates_.blocks.push_back(empty_block());
    SphereBlock& to = candidates_.blocks.back();
    to.center_x[at] = from.center_x[k];
    to.center_y[at] = from.center_y[k];
    to.center_z[at] = from.center_z[k];
    to.radius[at] = from.radius[k];
    candidates_.ids.push_back(block.id(k));
  }
}

/// Takes the spheres of a block, and those of later blocks that may be near one of them.
/// Returns how many are the block's own.
std::size_t PairFinder::gather(std::size_t block) {
  candidates_.blocks.clear();
  candidates_.ids.clear();
  const PlacedBlock own = blocks_.at(block);
  take(own, filled_slots(own.spheres()));
  const std::size_t count = candidates_.ids.size();
  if (count == 0) return 0;
  const auto [low, high, radius] = box_of(candidates_.blocks[0], count);
  const auto outside = [](float x, float least, float most) {
    const float out = std::max(least - x, x - most);
    return std::max(out, 0.0F);
  };
  // Spheres within this of the centres' box are in boxes that are.
  const double reach = std::clamp(double{radius} + gap_, 0.0, 1e200);
  const Vec3d least = vec_cast<double>(low), most = vec_cast<double>(high);
  const NearBox near((least + most) * 0.5, (most - least) * 0.5 + Vec3d{reach, reach, reach});
  blocks_.visit_near(near, [&, &low = low, &high = high, &radius = radius](std::size_t index) {
    if (index <= block) return;
    const PlacedBlock later = blocks_.at(index);
    const SphereBlock& spheres = later.spheres();
    take(later, near_slots(spheres, radius, [&](std::size_t k) {
           const float x = outside(spheres.center_x[k], low.x, high.x);
           const float y = outside(spheres.center_y[k], low.y, high.y);
           const float z = outside(spheres.center_z[k], low.z, high.z);
           return x * x + y * y + z * z;
         }));
  });
  return count;
}

void PairFinder::find(std::size_t block, std::vector<SpherePair>& pairs) {
  const std::size_t count = gather(block);
  const std::vector<std::int32_t>& ids = candidates_.ids;
  for (std::size_t i = 0; i < count; ++i) {
    const Ball ball = ball_in(candidates_.blocks[0], i);
    const Vec3d center = vec_cast<double>(ball.center);
    // Itself makes pairs with its copies.
    std::uint32_t wanted = ~0U << (geometry_.lacks_copies() ? i : i + 1);
    for (std::size_t b = 0; b < candidates_.blocks.size(); ++b, wanted = ~0U) {
      const SphereBlock& spheres = candidates_.blocks[b];
      std::uint32_t near = wanted & near_slots(spheres, ball.radius, [&](std::size_t k) {
                             const float x = spheres.center_x[k] - ball.center.x;
                             const float y = spheres.center_y[k] - ball.center.y;
                             const float z = spheres.center_z[k] - ball.center.z;
                             return x * x + y * y + z * z;
                           });
      for (; near != 0; near &= near - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(near));
        Ball both = ball_in(spheres, k);
        both.more = ball.radius;
        const double gap = find_distance(both, center);
        if (gap < gap_ || (gap == gap_ && is_within(both, center, gap_)))
          add(ids[i], ids[b * bvh_leaf_size + k], gap, pairs);
      }
    }
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
