#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/stream.h"
#include "simd/lanes/lanes.h"

/// A stream as whole packets.
namespace boule::BOULE_KERNEL_ISA {

/// Where a packet's rays are.
struct PacketPlace {
  const RayStream* rays;
  std::size_t first;
};

/// The last packet is filled up with copies of the last ray: they can neither change nor slow down
/// the others.
class PaddedStream {
 public:
  explicit PaddedStream(const RayStream& rays)
      : rays_(rays),
        tail_{org_x_, org_y_, org_z_,  dir_x_,  dir_y_, dir_z_,
              tmin_,  tmax_,  source_, inside_, lanes},
        tail_begin_(rays.size / lanes * lanes) {
    if (tail_begin_ == rays.size) return;
    for (std::size_t lane = 0; lane < lanes; ++lane) copy(lane);
  }
  PaddedStream(const PaddedStream&) = delete;
  PaddedStream& operator=(const PaddedStream&) = delete;

  [[nodiscard]] const RayStream& rays() const { return rays_; }
  /// The packet that begins at ray `first`, a multiple of W.
  [[nodiscard]] PacketPlace packet(std::size_t first) const {
    if (first < tail_begin_) return {&rays_, first};
    return {&tail_, 0};
  }
  /// How many of its rays are the stream's.
  [[nodiscard]] std::size_t live(std::size_t first) const {
    return rays_.size - first < lanes ? rays_.size - first : lanes;
  }

 private:
  static constexpr auto lanes = static_cast<std::size_t>(width);

  void copy(std::size_t lane) {
    const std::size_t wanted = tail_begin_ + lane;
    const std::size_t i = wanted < rays_.size ? wanted : rays_.size - 1;
    org_x_[lane] = rays_.org_x[i];
    org_y_[lane] = rays_.org_y[i];
    org_z_[lane] = rays_.org_z[i];
    dir_x_[lane] = rays_.dir_x[i];
    dir_y_[lane] = rays_.dir_y[i];
    dir_z_[lane] = rays_.dir_z[i];
    tmin_[lane] = rays_.tmin[i];
    tmax_[lane] = rays_.tmax[i];
    source_[lane] = rays_.source[i];
    inside_[lane] = rays_.inside[i];
  }

  alignas(64) double org_x_[lanes], org_y_[lanes], org_z_[lanes];
  alignas(64) float dir_x_[lanes], dir_y_[lanes], dir_z_[lanes], tmin_[lanes], tmax_[lanes];
  alignas(64) std::int32_t source_[lanes];
  alignas(64) std::uint8_t inside_[lanes];
  RayStream rays_, tail_;
  std::size_t tail_begin_;
};

}  // namespace boule::BOULE_KERNEL_ISA
