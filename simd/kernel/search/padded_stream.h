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
    each_array([k, i](auto& to, auto& from) { to.values[k] = from[i]; }, rays_, rays);
  }
  /// The first `size`.
  [[nodiscard]] RayStream view(std::size_t size) {
    RayStream rays{};
    each_array([](auto& pointer, auto& array) { pointer = array.values; }, rays, rays_);
    rays.size = size;
    return rays;
  }

 private:
  template <class T>
  struct Fixed {
    alignas(stream_alignment) T values[capacity];
  };
  RayArrays<Fixed> rays_;
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
