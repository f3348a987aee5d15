#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/bundle/bundle_extent.h"
#include "simd/kernel/search/bundle/bundle_frame.h"
#include "simd/kernel/tuning.h"

/// The order of sorted shadow rays. Neighbours in the picture may be far apart as seen from a
/// light, and rays of distant pixels close together. Sorted by their place as the light sees it,
/// rays make good bundles. The order affects only the time, so plain float is enough here.
namespace boule::BOULE_KERNEL_ISA {

/// Maps rays to a plane as a light sees them: by their directions from the light or, with a common
/// direction, by their origins.
template <Common common>
class LightMap {
 public:
  /// A map for rays begin .. end - 1: its middle is their mean direction.
  LightMap(const RayStream& rays, std::size_t begin, std::size_t end) {
    Vec3d forward{0, 0, 0};
    const std::size_t step = (end - begin + tuning::light_samples - 1) / tuning::light_samples;
    for (std::size_t i = begin; i < end; i += step)
      forward = forward + normalize(direction_of(rays, i));
    const BundleFrame frame = make_frame({0, 0, 0}, forward, {1, 0, 0});
    u_ = narrow_all(frame.u);
    v_ = narrow_all(frame.v);
    w_ = narrow_all(frame.w);
  }

  struct Point {
    Real x, y;
  };
  BOULE_INLINE Point point_of(const Vec3<Real>& sight) const {
    const Real x = filter_dot(sight, u_), y = filter_dot(sight, v_);
    if constexpr (common == Common::direction) {
      return {x, y};
    } else {
      // All directions on an octahedron, unfolded around W (Meyer and others, "On floating-point
      // normal vectors", 2010).
      const Real zero(0.0F), one(1.0F), z = filter_dot(sight, w_);
      const Real inverse = one / (abs(x) + abs(y) + abs(z));
      const Real p = x * inverse, q = y * inverse;
      const Real far_p = select(p < zero, abs(q) - one, one - abs(q));
      const Real far_q = select(q < zero, abs(p) - one, one - abs(p));
      const RealMask behind = z < zero;
      return {select(behind, far_p, p), select(behind, far_q, q)};
    }
  }

 private:
  Vec3<Real> u_{Real(0.0F), Real(0.0F), Real(0.0F)}, v_ = u_, w_ = u_;
};

/// A Hilbert curve through the cells of a square: neighbours on it are neighbours in the square, so
/// that bundles along it are compact.
class LightCurve {
 public:
  static constexpr unsigned side = tuning::light_grid_side(tuning::pool_size);

  constexpr LightCurve() {
    for (unsigned y = 0; y < side; ++y) {
      for (unsigned x = 0; x < side; ++x) position_[y * side + x] = find(x, y);
    }
  }
  [[nodiscard]] constexpr std::uint16_t position(unsigned cell) const { return position_[cell]; }

 private:
  /// The curve goes through one quarter after the other. In the lower two it is mirrored, so that
  /// it leaves each quarter beside the next.
  static constexpr std::uint16_t find(unsigned x, unsigned y) {
    unsigned position = 0;
    for (unsigned half = side / 2; half != 0; half /= 2) {
      const bool right = (x & half) != 0, up = (y & half) != 0;
      position = 4 * position + (right ? (up ? 2 : 3) : (up ? 1 : 0));
      if (up) continue;
      const unsigned turn = right ? side - 1 : 0, other = x ^ turn;
      x = y ^ turn;
      y = other;
    }
    return static_cast<std::uint16_t>(position);
  }

  std::uint16_t position_[side * side] = {};
};
inline constexpr LightCurve light_curve;

/// A square grid over a light's map. Its cells are numbered along the curve.
class LightGrid {
 public:
  /// A grid for `size` rays over the points of some of them. Points beyond it belong to the cells
  /// at its border.
  LightGrid(const Extent& some, std::size_t size)
      : x_low_(some.a_low),
        y_low_(some.b_low),
        side_(tuning::light_grid_side(size)),
        finer_(std::countr_zero(LightCurve::side / static_cast<unsigned>(side_))) {
    const float x_size = some.a_high - some.a_low, y_size = some.b_high - some.b_low;
    const float larger = x_size > y_size ? x_size : y_size;
    scale_ = larger > 0 ? static_cast<float>(side_) / larger : 0.0F;
  }

  [[nodiscard]] unsigned cells() const { return static_cast<unsigned>(side_ * side_); }

  /// The cells of W rays.
  template <class Point>
  BOULE_INLINE void find_cells(const Point& point, std::uint16_t* cell) const {
    const Bits x = to_bits(cut_to_cells((point.x - x_low_) * scale_, side_ - 1));
    const Bits y = to_bits(cut_to_cells((point.y - y_low_) * scale_, side_ - 1));
    alignas(64) std::uint32_t place[width];
    store(place, (x + y * Bits(LightCurve::side)) << finer_);
    for (int lane = 0; lane < width; ++lane)
      cell[lane] = static_cast<std::uint16_t>(light_curve.position(place[lane]) >> 2 * finer_);
  }

 private:
  Real x_low_, y_low_, scale_{0.0F};
  int side_;   ///< number of cells along a side
  int finer_;  ///< log2 of the number of the curve's cells along a cell's side
};

/// A counting sort of rays by their cells.
class CellSort {
 public:
  explicit CellSort(unsigned cells) : cells_(cells) {
    for (unsigned c = 0; c < cells; ++c) next_[c] = 0;
  }
  /// Counts a ray. Call it once for every ray, with its cell.
  BOULE_INLINE void count(std::uint16_t cell) { ++next_[cell]; }
  /// Finds the order of the rays, once all are counted: `cell` has the cell of each.
  void find_order(const std::uint16_t* cell, std::size_t size, std::uint16_t* order) {
    unsigned before = 0;
    for (unsigned c = 0; c < cells_; ++c) {
      const unsigned count = next_[c];
      next_[c] = before;
      before += count;
    }
    for (std::size_t i = 0; i < size; ++i) order[next_[cell[i]]++] = static_cast<std::uint16_t>(i);
  }

 private:
  static_assert(tuning::pool_size <= 65536 && tuning::most_light_cells <= 65536);
  unsigned cells_;
  unsigned next_[tuning::most_light_cells];
};

}  // namespace boule::BOULE_KERNEL_ISA
