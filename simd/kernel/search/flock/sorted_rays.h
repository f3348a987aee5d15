#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/search/packet/packet_stream.h"
#include "simd/kernel/tuning.h"

/// Rays that start near each other and go in all directions, as after a bounce: sorted by their
/// directions, a few hundred at a time, so that the rays of a packet go much the same way. Chosen
/// for nearest hits if a trial finds it fastest (scattered_stream.h).
namespace boule::BOULE_KERNEL_ISA {

class SortedRays {
 public:
  SortedRays(const GeometryView& geometry, const PaddedStream& stream, const HitStream& hits)
      : geometry_(geometry), stream_(stream), hits_(hits) {}

  /// Traces rays begin .. end - 1 of the stream, `begin` a multiple of W.
  BOULE_NOINLINE void run(std::size_t begin, std::size_t end) {
    for (; begin < end; begin += size) {
      const std::size_t count = end - begin < size ? end - begin : size;
      sort(begin, count);
      const PaddedStream sorted(rays_.view(count));
      trace_groups(geometry_, sorted, 0, count, Solver::robust, Form::automatic,
                   HitStream{t_, id_, slot_, count});
      for (std::size_t k = 0; k < count; ++k) {
        hits_.t[order_[k]] = t_[k];
        hits_.id[order_[k]] = id_[k];
        hits_.slot[order_[k]] = slot_[k];
      }
    }
  }

 private:
  static constexpr std::size_t size = tuning::sorted_rays;
  /// The cells along each side of either half of an octahedron, to which directions are mapped
  /// (Engelhardt and Dachsbacher 2008, "Octahedron environment maps").
  static constexpr std::uint32_t side = tuning::sorted_side, cells = 2 * side * side;
  static_assert(side == 8);  // spread() has three bits

  /// The cells of W directions: along Morton's curve within each half.
  BOULE_INLINE static Bits cells_of(const Vec3<Real>& dir) {
    const Real scale = Real(side / 2.0F) / sum_abs(dir);
    const auto column = [&](const Real& component) {
      const Real at = (component * scale) + Real(side / 2.0F), last(side - 1.0F);
      const Real above = select(Real(0.0F) < at, at, Real(0.0F));  // NaN becomes 0
      return spread(to_bits(select(above < last, above, last)));
    };
    const Bits half = select(Real(0.0F) < dir.z, Bits(side * side), Bits(0U));
    return column(dir.x) | column(dir.y) << 1 | half;
  }
  /// Puts a zero behind each of three bits.
  BOULE_INLINE static Bits spread(const Bits& x) {
    return (x & Bits(1U)) | (x & Bits(2U)) << 1 | (x & Bits(4U)) << 2;
  }

  /// Copies these rays in the order of their cells.
  BOULE_INLINE void sort(std::size_t begin, std::size_t count) {
    const RayStream& rays = stream_.rays();
    std::uint16_t ends[cells + 1] = {};
    for (std::size_t first = 0; first < count; first += width)
      store(cell_ + first, cells_of(load_directions(rays, begin + first)));
    for (std::size_t k = 0; k < count; ++k) ++ends[cell_[k] + 1];
    for (std::uint32_t cell = 0; cell < cells; ++cell)
      ends[cell + 1] = static_cast<std::uint16_t>(ends[cell + 1] + ends[cell]);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t to = ends[cell_[k]]++;
      order_[to] = static_cast<std::uint32_t>(begin + k);
      rays_.set(to, rays, begin + k);
    }
  }

  const GeometryView& geometry_;
  const PaddedStream& stream_;
  const HitStream hits_;
  GatheredRays<size> rays_;
  alignas(64) std::uint32_t cell_[size + max_width];
  std::uint32_t order_[size];
  alignas(64) double t_[size];
  alignas(64) std::int32_t id_[size];
  alignas(64) std::uint32_t slot_[size];
};

}  // namespace boule::BOULE_KERNEL_ISA
