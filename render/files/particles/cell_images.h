#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// Moves positions by whole vectors of the cell, along its periodic directions, so that they lie in
/// it but for rounding; what lies in it stays as it is. A vector of length 0 stands for a direction
/// that is not periodic. An error, about "wrap", if the vectors lie in a plane and if a position is
/// too far away to be moved exactly enough.
Status wrap_into(const ParticleCell& cell, std::vector<Vec3d>& positions,
                 const ParallelFor& parallel_for);

/// How many vectors a, b and c an image is away from where the frame has the particles.
using ImagePlace = std::array<std::int64_t, 3>;

/// Where the periodic images of a cell are.
class CellImages {
 public:
  /// The particles themselves.
  CellImages() = default;
  /// `counts` images along a, b and c, >= 1 each; their product fits into a std::size_t.
  CellImages(const ParticleCell& cell, const std::array<int, 3>& counts)
      : cell_(cell), counts_(counts) {}

  [[nodiscard]] std::size_t size() const;

  /// By how much an image is moved; image 0 is not. The next ones follow along a, then b, then c.
  [[nodiscard]] Vec3d shift(std::size_t image) const;

  /// How many vectors a, b and c an image is away from image 0.
  [[nodiscard]] ImagePlace place(std::size_t image) const;
  /// By how much what is so many vectors away is moved, among the images or beyond them.
  [[nodiscard]] Vec3d shift(const ImagePlace& place) const;
  [[nodiscard]] const std::array<int, 3>& counts() const { return counts_; }

 private:
  ParticleCell cell_{};
  std::array<int, 3> counts_{1, 1, 1};
};

}  // namespace boule
