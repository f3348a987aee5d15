#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/abi/stream.h"
#include "simd/lanes/lanes.h"

/// A stream of any length as whole packets of W rays, and rays gathered from any places in a
/// stream.
namespace boule::BOULE_KERNEL_ISA {

/// W rays in memory: those from `first` on.
struct PacketRef {
  const RayStream* rays;
  std::size_t first;
};

/// Prefetches the packet at `first` into the cache, unless the stream ends before it.
BOULE_INLINE void prefetch_packet(const RayStream& rays, std::size_t first) {
  if (first >= rays.size) return;
  if (!rays.shared.has_origin()) {
    for (int line = 0; line * 8 < width; ++line) {
      __builtin_prefetch(rays.org_x + first + line * 8);
      __builtin_prefetch(rays.org_y + first + line * 8);
      __builtin_prefetch(rays.org_z + first + line * 8);
    }
  }
  if (!rays.shared.has_direction()) {
    __builtin_prefetch(rays.dir_x + first);
    __builtin_prefetch(rays.dir_y + first);
    __builtin_prefetch(rays.dir_z + first);
  }
  if (!rays.shared.has_start()) {
    __builtin_prefetch(rays.tmin + first);
    __builtin_prefetch(rays.source + first);
  }
  __builtin_prefetch(rays.tmax + first);
}

/// Copies of some rays of a stream, side by side.
template <std::size_t capacity>
class GatheredRays {
 public:
  /// Copies ray i of the stream to index k.
  BOULE_INLINE void set(std::size_t k, const RayStream& rays, std::size_t i) {
    each_array(
        rays.places(i), [k](std::size_t at, auto& to, auto& from) { to.values[k] = from[at]; },
        rays_, rays);
  }
  /// A view of the first `size` copies.
  [[nodiscard]] RayStream view(std::size_t size) {
    RayStream rays{};
    each_array(
        {}, [](std::size_t, auto& to, auto& array) { to = array.values; }, rays, rays_);
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

/// A stream whose last packet is filled up with copies of the last ray. Copies leave the search of
/// the other rays as it is, also in speed.
class PaddedStream {
 public:
  explicit PaddedStream(const RayStream& rays)
      : rays_(rays), tail_begin_(rays.size / width * width) {
    if (tail_begin_ == rays.size) return;
    for (std::size_t lane = 0; lane < width; ++lane) copy(lane);
    tail_ = copies_.view(width);
  }
  PaddedStream(const PaddedStream&) = delete;
  PaddedStream& operator=(const PaddedStream&) = delete;

  [[nodiscard]] const RayStream& rays() const { return rays_; }
  /// The packet that begins at ray `first`, a multiple of W.
  [[nodiscard]] PacketRef packet(std::size_t first) const {
    if (first < tail_begin_) return {&rays_, first};
    return {&tail_, 0};
  }
  /// The number of rays of that packet that belong to the stream, without the copies.
  [[nodiscard]] std::size_t live(std::size_t first) const {
    return rays_.size - first < width ? rays_.size - first : width;
  }

 private:
  void copy(std::size_t lane) {
    const std::size_t wanted = tail_begin_ + lane;
    copies_.set(lane, rays_, wanted < rays_.size ? wanted : rays_.size - 1);
  }

  GatheredRays<width> copies_;
  RayStream rays_, tail_{};
  std::size_t tail_begin_;
};

}  // namespace boule::BOULE_KERNEL_ISA
