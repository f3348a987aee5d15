#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/error.h"
#include "render/renderer/point_columns.h"

namespace boule {

/// An error about the first point that has no distance, with its row; rows count from `first_row`.
Status check_points(const PointColumns& points, std::uint64_t first_row = 0);

/// An order of points in which those that follow one another are often close, so that they find
/// what they need in the caches.
struct PointOrder {
  std::vector<std::uint32_t> rows;  ///< counted from the first point

  /// Orders the points first .. first + count - 1. Precondition: all are finite, and fewer than
  /// 2^32.
  void make(const PointColumns& points, std::size_t first, std::size_t count);

 private:
  std::vector<std::uint32_t> cells_, ends_;
};

}  // namespace boule
