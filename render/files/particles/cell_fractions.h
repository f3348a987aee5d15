#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/math/geometry.h"
#include "core/math/vec.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// From positions to fractions of a cell's vectors.
class CellFractions {
 public:
  /// Nothing if the vectors lie in a plane. One of length 0 stands for some direction.
  static std::optional<CellFractions> of(const ParticleCell& cell);

  /// The fraction of vector i, in [0, 1] inside of the cell.
  [[nodiscard]] double fraction(std::size_t i, const Vec3d& position) const {
    return dot(rows_[i], position - origin_);
  }

  /// How many whole vectors i a position is away from the cell.
  [[nodiscard]] double cells(std::size_t i, const Vec3d& position) const {
    return std::floor(fraction(i, position));
  }

  /// By how much fraction i changes along a way of length 1, at most.
  [[nodiscard]] double steepness(std::size_t i) const { return std::sqrt(dot(rows_[i], rows_[i])); }

 private:
  std::array<Vec3d, 3> rows_{};
  Vec3d origin_;
};

}  // namespace boule
