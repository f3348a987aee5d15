#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/cell_images.h"

namespace boule {

/// The images of particles on the faces of a cell, of all its images together, that lie on the
/// opposite faces: of one on an edge there are three, of one in a corner seven.
class BoundaryImages {
 public:
  /// None.
  BoundaryImages() = default;

  /// A particle lies on a face if its fraction is at most this away from 0 or 1.
  static constexpr double tolerance = 1e-3;

  /// Along the cell's periodic directions, of which there are `counts` images. A vector of length 0
  /// stands for a direction that is not periodic. An error, about "boundary", if the vectors lie in
  /// a plane, and if there is no memory.
  static Result<BoundaryImages> find(const ParticleCell& cell, const std::array<int, 3>& counts,
                                     const std::vector<Vec3d>& positions,
                                     const ParallelFor& parallel_for);

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Whether a particle is repeated at `place` along vector k: before all images, or behind them.
  [[nodiscard]] bool repeats(std::size_t particle, std::size_t k, std::int64_t place) const {
    if (faces_.empty()) return false;
    if (place == -1) return (faces_[particle] & (behind << k)) != 0;
    return place == counts_[k] && (faces_[particle] & (before << k)) != 0;
  }

  /// Calls visit(place) for each image of a particle: along a, then b, then c.
  template <class Visit>
  void each_of(std::size_t particle, const Visit& visit) const {
    if (faces_.empty() || faces_[particle] == 0) return;
    const ImagePlace first = first_of(faces_[particle]), last = last_of(faces_[particle]);
    for (std::int64_t z = first[2]; z <= last[2]; ++z) {
      for (std::int64_t y = first[1]; y <= last[1]; ++y) {
        for (std::int64_t x = first[0]; x <= last[0]; ++x) {
          if (!is_of_cell({x, y, z})) visit(ImagePlace{x, y, z});
        }
      }
    }
  }

  /// Calls visit(particle, place) for all, one particle after the other.
  template <class Visit>
  void each(const Visit& visit) const {
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      each_of(i, [&](const ImagePlace& place) { visit(i, place); });
    }
  }

 private:
  // Of a particle, for vector k shifted by k: its fraction is 0, or 1.
  static constexpr std::uint8_t before = 1, behind = 8;

  [[nodiscard]] ImagePlace first_of(std::uint8_t faces) const;
  [[nodiscard]] ImagePlace last_of(std::uint8_t faces) const;
  [[nodiscard]] bool is_of_cell(const ImagePlace& place) const;
  [[nodiscard]] std::size_t count() const;

  std::array<int, 3> counts_{1, 1, 1};
  std::vector<std::uint8_t> faces_;  ///< by particle; empty: none
  std::size_t size_ = 0;
};

}  // namespace boule
