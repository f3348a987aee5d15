#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec.h"
#include "render/renderer/ray_columns.h"

namespace boule {

/// Points that a Tracer reads: a list, or numbers in the layout of numpy, three components each. A
/// view.
class PointColumns {
 public:
  PointColumns(std::span<const Vec3d> points)
      : size_(points.size()),
        numbers_{reinterpret_cast<const unsigned char*>(points.data()), sizeof(Vec3d),
                 sizeof(double), true} {}
  PointColumns(const std::vector<Vec3d>& points) : PointColumns(std::span(points)) {}
  /// `zero` is subtracted from the points, in double.
  PointColumns(std::size_t size, const RayNumbers& numbers, const Vec3d& zero)
      : size_(size), numbers_(numbers), zero_(zero) {}

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Vec3d at(std::size_t k) const {
    return Vec3d{numbers_.at(k, 0), numbers_.at(k, 1), numbers_.at(k, 2)} - zero_;
  }

 private:
  std::size_t size_;
  RayNumbers numbers_;
  Vec3d zero_{};
};

/// Some points of a call.
struct PointRows {
  std::size_t first;
  std::span<const std::uint32_t> rows;  ///< counted from `first`

  template <class Visit>
  void visit(const Visit& visit_row) const {
    for (const std::uint32_t row : rows) visit_row(first + row);
  }
};

}  // namespace boule
