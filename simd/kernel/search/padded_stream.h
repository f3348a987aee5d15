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

/// So many rays ahead a stream's next packets are asked for.
inline constexpr std::size_t prefetch_distance = 4 * static_cast<std::size_t>(width);

/// Asks for the packet at `first`, unless the stream ends before it: rays come once, and from
/// memory.
BOULE_INLINE void prefetch_packet(const RayStream& rays, std::size_t first) {
  if (first >= rays.size) return;
  for (int line = 0; line * 8 < width; ++line) {
    __builtin_prefetch(rays.org_x + first + line * 8);
    __builtin_prefetch(rays.org_y + first + line * 8);
    __builtin_prefetch(rays.org_z + first + line * 8);
  }
  __builtin_prefetch(rays.dir_x + first);
  __builtin_prefetch(rays.dir_y + first);
  __builtin_prefetch(rays.dir_z + first);
  __builtin_prefetch(rays.tmin + first);
  __builtin_prefetch(rays.tmax + first);
  __builtin_prefetch(rays.source + first);
}

/// Some rays of a stream side by side, wherever they are in it.
template <std::size_t capacity>
class GatheredRays {
 public:
  /// Takes ray i of the stream as its k-th.
  BOULE_INLINE void set(std::size_t k, const RayStream& rays, std::size_t i) {
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
  /// The first `size`.
  [[nodiscard]] RayStream view(std::size_t size) {
    return {org_x_, org_y_, org_z_, dir_x_, dir_y_, dir_z_, tmin_, tmax_, source_, inside_, size};
  }

 private:
  alignas(64) double org_x_[capacity], org_y_[capacity], org_z_[capacity];
  alignas(64) float dir_x_[capacity], dir_y_[capacity], dir_z_[capacity];
  alignas(64) float tmin_[capacity], tmax_[capacity];
  alignas(64) std::int32_t source_[capacity];
  alignas(64) std::uint8_t inside_[capacity];
};

/// The last packet is filled up with copies of the last ray: they can neither change nor slow down
/// the others.
class PaddedStream {
 public:
  explicit PaddedStream(const RayStream& rays)
      : rays_(rays), tail_begin_(rays.size / lanes * lanes) {
    if (tail_begin_ == rays.size) return;
    for (std::size_t lane = 0; lane < lanes; ++lane) copy(lane);
    tail_ = copies_.view(lanes);
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
    copies_.set(lane, rays_, wanted < rays_.size ? wanted : rays_.size - 1);
  }

  GatheredRays<lanes> copies_;
  RayStream rays_, tail_{};
  std::size_t tail_begin_;
};

}  // namespace boule::BOULE_KERNEL_ISA
