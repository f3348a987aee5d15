#pragma once

#include <cstddef>

#include "simd/kernel/search/flight.h"
#include "simd/kernel/search/slabs.h"

/// Rays on their way into flight: what their steps need is computed for W at a time, and kept until
/// there is room for each.
namespace boule::BOULE_KERNEL_ISA {

/// W rays that are ready to start.
class Departures {
 public:
  /// `reach`: nothing beyond this t |dir| is of interest; `extent`: BvhView::extent.
  BOULE_INLINE void set(const RayLanes& packet, const Real& reach, float extent) {
    const FilterRays& rays = packet.filter;
    const auto [x, y, z] = slabs_of(packet, extent);
    store_rows(row_[0][0], {x.inverse, y.inverse, z.inverse, reach});
    store_rows(row_[1][0], {x.near, y.near, z.near, rays.live_from});
    store_rows(row_[2][0], {x.far, y.far, z.far, rays.live_to});
    store_rows(row_[3][0], {rays.org.x, rays.org.y, rays.org.z, rays.origin_error});
    store_rows(row_[4][0], {rays.unit.x, rays.unit.y, rays.unit.z, rays.unit.z});
    judged_ = bits(is_judged(rays));
    open_ = bits(Real(0.0F) <= reach);
  }
  /// Copies the ray of a lane.
  BOULE_INLINE void get(std::size_t lane, FlightRay& ray) const {
    static_assert(sizeof(FlightRay) == FlightRay::rows * sizeof row_[0][0]);
    get_row<0>(lane, ray);
    get_row<1>(lane, ray);
    get_row<2>(lane, ray);
    get_row<3>(lane, ray);
    get_row<4>(lane, ray);
  }
  /// Whether floats can judge the ray, and it has no hits behind its origin: only then it can fly.
  [[nodiscard]] BOULE_INLINE bool judged(std::size_t lane) const {
    return (judged_ >> lane & 1U) != 0;
  }
  /// Whether there is anything to be found: its interval is not empty.
  [[nodiscard]] BOULE_INLINE bool open(std::size_t lane) const { return (open_ >> lane & 1U) != 0; }

 private:
  template <std::size_t row>
  BOULE_INLINE void get_row(std::size_t lane, FlightRay& ray) const {
    constexpr std::size_t size = sizeof row_[row][0];
    __builtin_memcpy(reinterpret_cast<char*>(&ray) + row * size, row_[row][lane], size);
  }

  unsigned judged_ = 0, open_ = 0;
  alignas(64) float row_[FlightRay::rows][width][4];
};

}  // namespace boule::BOULE_KERNEL_ISA
