#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "core/math/vec.h"
#include "render/frame/point_lists.h"
#include "simd/geometry/geometry.h"
#include "simd/points/point_distance.h"

namespace boule {

/// Calls visit(id) for a primitive, and for the copies of it that the tree leaves out.
template <class Visit>
void for_copies(const Geometry& geometry, std::int32_t id, const Visit& visit) {
  visit(id);
  if (!geometry.lacks_copies()) return;
  for (const SphereCopy& copy : geometry.copies_of(id)) visit(copy.id);
}

/// A visitor of PointSearch that finds the nearest primitives of a point, up to k of them. Rough
/// distances tell which these may be; only of those is the exact one found.
class NearestVisitor {
 public:
  NearestVisitor(const Geometry& geometry, std::size_t k, double limit)
      : geometry_(geometry), k_(k), most_(limit) {}

  void start(const Vec3d& point);
  [[nodiscard]] double limit() const { return limit_; }
  template <class Shape>
  void meet(const Shape& shape, std::int32_t id) {
    const RoughDistance rough = rough_distance(shape, point_);
    if (rough.value - rough.error > limit_) return;
    for_copies(geometry_, id, [&](std::int32_t each) { add(rough, shape, each); });
  }
  /// Sets k distances and ids.
  void finish(double* distance, std::int32_t* id);

 private:
  using Shape = std::variant<Ball, Capsule, Plane>;
  struct Candidate {
    double least;
    std::int32_t id;
    Shape shape;
  };

  void add(const RoughDistance& rough, const Shape& shape, std::int32_t id);

  const Geometry& geometry_;
  std::size_t k_;
  double most_;
  Vec3d point_{};
  double limit_ = 0;
  std::vector<Candidate> candidates_;
  std::vector<double> upper_;  ///< a heap: the k smallest upper bounds
  std::vector<std::pair<double, std::int32_t>> found_;
};

/// A visitor of PointSearch that lists all primitives within a distance of a point.
class MemberVisitor {
 public:
  explicit MemberVisitor(const Geometry& geometry) : geometry_(geometry) {}

  /// Precondition: `limit` is not NaN.
  void start(const Vec3d& point, double limit) {
    point_ = point;
    limit_ = limit;
    ids_.clear();
  }
  [[nodiscard]] double limit() const { return limit_; }
  template <class Shape>
  void meet(const Shape& shape, std::int32_t id) {
    if (!is_within(shape, point_, limit_)) return;
    for_copies(geometry_, id, [&](std::int32_t each) { ids_.push_back(each); });
  }
  /// The ids, in order.
  const std::vector<std::int32_t>& finish();

 private:
  const Geometry& geometry_;
  Vec3d point_{};
  double limit_ = 0;
  std::vector<std::int32_t> ids_;
};

}  // namespace boule
