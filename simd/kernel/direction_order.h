#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/bundle_rays.h"

/// Neighbours in the picture may be far apart as a light sees them, and others close together: a
/// pool of some thousand rays is sorted by where they are for the light. Only the time depends on
/// the order, so plain floats do.
namespace boule::BOULE_KERNEL_ISA {

/// Rays that are sorted together.
inline constexpr std::size_t pool_size = 65536;

/// Where rays are on a square that the light sees.
template <Common common>
class LightView {
 public:
  /// Rays begin .. end - 1.
  LightView(const RayStream& rays, std::size_t begin, std::size_t end) {
    Vec3d forward{0, 0, 0};
    const std::size_t step = (end - begin + 31) / 32;
    for (std::size_t i = begin; i < end; i += step)
      forward = forward + scaled_to_unit(direction_of(rays, i));
    const BundleFrame frame = make_frame(origin_of(rays, begin), forward, {1, 0, 0});
    org_ = wide_all(frame.org);
    u_ = narrow_all(frame.u);
    v_ = narrow_all(frame.v);
    w_ = narrow_all(frame.w);
  }

  struct Place {
    Real x, y;
  };
  BOULE_INLINE Place place(const PacketPlace& packet) const {
    const RayStream& rays = *packet.rays;
    const std::size_t first = packet.first;
    if constexpr (common == Common::direction) {
      const Vec3<Wide> org{load(rays.org_x + first), load(rays.org_y + first),
                           load(rays.org_z + first)};
      const Vec3<Real> off = narrow(org - org_);
      return {filter_dot(off, u_), filter_dot(off, v_)};
    } else {
      // All directions on an octahedron, unfolded around W (Meyer and others, "On floating-point
      // normal vectors", 2010).
      const Vec3<Real> dir{load(rays.dir_x + first), load(rays.dir_y + first),
                           load(rays.dir_z + first)};
      const Real zero(0.0F), one(1.0F);
      const Real x = filter_dot(dir, u_), y = filter_dot(dir, v_), z = filter_dot(dir, w_);
      const Real inverse = one / (abs(x) + abs(y) + abs(z));
      const Real p = x * inverse, q = y * inverse;
      const Real far_p = select(p < zero, abs(q) - one, one - abs(q));
      const Real far_q = select(q < zero, abs(p) - one, one - abs(p));
      const RealMask behind = z < zero;
      return {select(behind, far_p, p), select(behind, far_q, q)};
    }
  }

 private:
  Vec3<Wide> org_{Wide(0.0), Wide(0.0), Wide(0.0)};
  Vec3<Real> u_{Real(0.0F), Real(0.0F), Real(0.0F)}, v_ = u_, w_ = u_;
};

/// The rays of a pool in the order of their cells on a square grid, along a Morton curve.
class DirectionOrder {
 public:
  /// Sorts rays begin .. end - 1, at most pool_size; `begin` is a multiple of W.
  template <Common common>
  BOULE_NOINLINE void sort(const PaddedStream& stream, std::size_t begin, std::size_t end) {
    begin_ = begin;
    size_ = end - begin;
    const LightView<common> view(stream.rays(), begin, end);
    const Grid grid = make_grid(stream, view);
    for (std::size_t at = 0; at < size_; at += width) {
      const PacketPlace packet = stream.packet(begin + at);
      prefetch_packet(*packet.rays, packet.first);
      grid.find_cells(view.place(packet), cell_ + at);
    }
    put_in_order(grid.cells());
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  /// The ray that comes k-th.
  [[nodiscard]] std::size_t operator[](std::size_t k) const { return begin_ + order_[k]; }

 private:
  using Index = std::uint16_t;
  static constexpr unsigned most_cells = 4096;
  static_assert(pool_size <= 65536 && most_cells <= 65536);

  struct Grid {
    float x_low, y_low, scale;
    unsigned side;  ///< in cells: a power of two

    [[nodiscard]] unsigned cells() const { return side * side; }

    template <class Place>
    BOULE_INLINE void find_cells(const Place& place, Index* cell) const {
      alignas(64) float x[width], y[width];
      store(x, cut_to_cells((place.x - x_low) * scale, static_cast<int>(side) - 1));
      store(y, cut_to_cells((place.y - y_low) * scale, static_cast<int>(side) - 1));
      for (int lane = 0; lane < width; ++lane) cell[lane] = curve_position(x[lane], y[lane]);
    }
  };

  /// Fits a grid to some of the rays; the others are cut to it.
  template <Common common>
  Grid make_grid(const PaddedStream& stream, const LightView<common>& view) const {
    constexpr std::size_t step = 128;
    ExtentLanes some;
    for (std::size_t at = 0; at < size_; at += step) {
      const auto place = view.place(stream.packet(begin_ + at));
      some.add(place.x, place.y);
    }
    const Extent e = some.total();
    const float x_size = e.a_high - e.a_low, y_size = e.b_high - e.b_low;
    const float size = x_size > y_size ? x_size : y_size;
    const unsigned side = size_ < 1024 ? 16 : size_ < 4096 ? 32 : 64;
    return {e.a_low, e.b_low, size > 0 ? static_cast<float>(side) / size : 0.0F, side};
  }

  /// The bits of x and y, of which there are six, in turn.
  BOULE_INLINE static Index curve_position(float x, float y) {
    unsigned both = static_cast<unsigned>(static_cast<int>(x)) |
                    static_cast<unsigned>(static_cast<int>(y)) << 16;
    both = (both | both << 4) & 0x030f030fU;
    both = (both | both << 2) & 0x03330333U;
    both = (both | both << 1) & 0x05550555U;
    return static_cast<Index>((both | both >> 15) & 0xfffU);
  }

  /// A counting sort.
  void put_in_order(unsigned cells) {
    unsigned next[most_cells];
    for (unsigned c = 0; c < cells; ++c) next[c] = 0;
    for (std::size_t i = 0; i < size_; ++i) ++next[cell_[i]];
    unsigned before = 0;
    for (unsigned c = 0; c < cells; ++c) {
      const unsigned count = next[c];
      next[c] = before;
      before += count;
    }
    for (std::size_t i = 0; i < size_; ++i) order_[next[cell_[i]]++] = static_cast<Index>(i);
  }

  std::size_t begin_ = 0, size_ = 0;
  Index order_[pool_size];
  Index cell_[pool_size + max_width];
};

/// Rays of a pool side by side: a stream of its own.
class PooledRays {
 public:
  PooledRays() = default;
  PooledRays(const PooledRays&) = delete;
  PooledRays& operator=(const PooledRays&) = delete;

  /// Rays first .. first + size - 1 of `order`.
  RayStream gather(const RayStream& rays, const DirectionOrder& order, std::size_t first,
                   std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t i = order[first + k];
      org_x_[k] = rays.org_x[i];
      org_y_[k] = rays.org_y[i];
      org_z_[k] = rays.org_z[i];
      dir_x_[k] = rays.dir_x[i];
      dir_y_[k] = rays.dir_y[i];
      dir_z_[k] = rays.dir_z[i];
      tmin_[k] = rays.tmin[i];
      tmax_[k] = rays.tmax[i];
      source_[k] = rays.source[i];
      inside_[k] = rays.inside[i];
    }
    return {org_x_, org_y_, org_z_, dir_x_, dir_y_, dir_z_, tmin_, tmax_, source_, inside_, size};
  }

 private:
  alignas(64) double org_x_[bundle_size], org_y_[bundle_size], org_z_[bundle_size];
  alignas(64) float dir_x_[bundle_size], dir_y_[bundle_size], dir_z_[bundle_size];
  alignas(64) float tmin_[bundle_size], tmax_[bundle_size];
  alignas(64) std::int32_t source_[bundle_size];
  alignas(64) std::uint8_t inside_[bundle_size];
};

}  // namespace boule::BOULE_KERNEL_ISA
