#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/abi/isa.h"
#include "simd/kernel/search/leaf/padded_stream.h"
#include "simd/kernel/search/leaf/ray_lanes.h"
#include "simd/kernel/tuning.h"

/// The sources of a bundle's rays. Bundles read a source packet by packet: here neighbours in a
/// stream (RaysInOrder), in ray_pool.h neighbours in a sorted pool (RaysOfPool).
namespace boule::BOULE_KERNEL_ISA {

/// The part that a bundle's rays have in common: their origin, their direction, or their end, which
/// is the point at t = 1. Rays with a common end are seen from that end, backwards.
enum class Common { origin, direction, end };

/// The kind of hit that is sought: the nearest one, or any.
enum class Sought { nearest, any };

BOULE_INLINE Vec3d direction_of(const RayStream& rays, std::size_t i) {
  const std::size_t at = rays.places(i).dir;
  return {double{rays.dir_x[at]}, double{rays.dir_y[at]}, double{rays.dir_z[at]}};
}
BOULE_INLINE Vec3d origin_of(const RayStream& rays, std::size_t i) {
  const std::size_t at = rays.places(i).org;
  return {rays.org_x[at], rays.org_y[at], rays.org_z[at]};
}
BOULE_INLINE Vec3<Real> narrow_all(const Vec3d& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
BOULE_INLINE Vec3<Wide> wide_all(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// Writes W bits as bytes, 0 or 1; eight at a time, so that `bytes` needs room for max_width.
BOULE_INLINE void bytes_of(unsigned bits, std::uint8_t* bytes) {
  for (int at = 0; at < width; at += 8) {
    // Eight copies of the byte, each of which keeps one bit; adding 0x7f to each sets the top bit
    // of the nonzero ones.
    const std::uint64_t one_each = (bits >> at & 0xffU) * 0x0101010101010101U & 0x8040201008040201U;
    const std::uint64_t ones = (one_each + 0x7f7f7f7f7f7f7f7fU) >> 7 & 0x0101010101010101U;
    __builtin_memcpy(bytes + at, &ones, 8);
  }
}
/// Whether W bytes are all 0.
BOULE_INLINE bool all_zero(const std::uint8_t* bytes) {
  std::uint64_t words[max_width / 8] = {0};
  __builtin_memcpy(words, bytes, width);
  std::uint64_t any = 0;
  for (const std::uint64_t word : words) any |= word;
  return any == 0;
}

/// Whether W sources are all -1.
BOULE_INLINE bool none_leaves(const std::int32_t* sources) {
  std::uint64_t words[max_width / 2];
  __builtin_memset(words, 0xff, sizeof words);
  __builtin_memcpy(words, sources, width * sizeof *sources);
  std::uint64_t both = ~std::uint64_t{0};
  for (const std::uint64_t word : words) both &= word;
  return both == ~std::uint64_t{0};
}

/// The part in which W rays differ: their directions or, with a common direction, their origins
/// less O. O is the common origin or end or, with a common direction, the origin of one of the
/// rays.
struct Sight {
  Vec3<Real> sight;
  Real shift;  ///< with a common end: the distance from O at which this ray ends
};

/// The shared part of rays, taken from one of them: O and, with a common direction, that direction.
template <Common common>
class SharedByRays {
 public:
  SharedByRays(const RayStream& rays, std::size_t one)
      : dir_(direction_of(rays, one)),
        org_(common == Common::end ? origin_of(rays, one) + dir_ : origin_of(rays, one)),
        once_(stands_once(rays.shared)),
        from_zero_(rays.tmin[rays.places(one).start] == 0.0F),
        leaves_none_(rays.source[rays.places(one).start] == no_primitive) {}

  [[nodiscard]] const Vec3d& org() const { return org_; }
  [[nodiscard]] const Vec3d& dir() const { return dir_; }

  BOULE_INLINE Sight sight(const PacketRef& packet) const {
    const RayStream& rays = *packet.rays;
    if constexpr (common == Common::origin) {
      return {load_directions(rays, packet.first), Real(0.0F)};
    } else if constexpr (common == Common::end) {
      const Vec3<Real> dir = load_directions(rays, packet.first);
      const Vec3<Wide> end = load_origins(rays, packet.first) + widen(dir);
      return {dir, sum_abs(narrow(end - wide_all(org_)))};
    } else {
      return {narrow(load_origins(rays, packet.first) - wide_all(org_)), Real(0.0F)};
    }
  }

  /// Lanes whose rays may be in a bundle: their shared part is equal, their tmin is 0 and, for
  /// nearest hits, they leave no primitive.
  template <Sought sought>
  BOULE_INLINE RealMask belongs(const PacketRef& packet) const {
    if (once_) return uniform(from_zero_ && (sought == Sought::any || leaves_none_));
    const RayStream& rays = *packet.rays;
    const std::size_t first = packet.first, start = rays.places(first).start;
    const Real zero(0.0F), tmin = load(rays.tmin + start);
    RealMask fresh = (tmin <= zero) & (zero <= tmin);
    if constexpr (sought == Sought::nearest)
      fresh = fresh & uniform(none_leaves(rays.source + start));
    if constexpr (common == Common::end) {
      // Sight::shift decides later whether they share their end. Primitives beyond the end are
      // invisible from there: rays must stop at it.
      return fresh & (load(rays.tmax + first) <= Real(1.0F));
    } else if constexpr (common == Common::origin) {
      const Vec3<Wide> org = load_origins(rays, first), same_org = wide_all(org_);
      const WideMask same = (org.x == same_org.x) & (org.y == same_org.y) & (org.z == same_org.z);
      return fresh & uniform(all(same));
    } else {
      const Vec3<Real> dir = load_directions(rays, first), one = narrow_all(dir_);
      return fresh & (dir.x <= one.x) & (one.x <= dir.x) & (dir.y <= one.y) & (one.y <= dir.y) &
             (dir.z <= one.z) & (one.z <= dir.z);
    }
  }

 private:
  static bool stands_once(const SharedNumbers& shared) {
    if constexpr (common == Common::end) return false;
    return common == Common::origin ? shared.has_origin() : shared.has_direction();
  }

  Vec3d dir_, org_;
  bool once_;  ///< the stream has their shared part once, and also their starts
  bool from_zero_, leaves_none_;
};

/// The data of W rays of a bundle besides their lines, in memory.
struct PacketStart {
  const float* tmax;
  const std::int32_t* source;  ///< ids of the primitives that they leave, or -1
  const std::uint8_t* inside;  ///< 1 if a ray leaves that primitive on its inside
};

/// Neighbours in a stream, in the order of the stream.
template <Common common>
class RaysInOrder {
 public:
  /// Rays first .. first + count - 1 of the stream, count at most tuning::bundle_size. Their shared
  /// part is taken from the ray at three quarters, as in load_bundle().
  RaysInOrder(const PaddedStream& stream, std::size_t first, std::size_t count)
      : stream_(stream),
        first_(first),
        count_(static_cast<int>(count)),
        shared_(stream.rays(), first + count * 3 / 4) {}

  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const Vec3d& org() const { return shared_.org(); }
  [[nodiscard]] const Vec3d& dir() const { return shared_.dir(); }

  /// The sight of ray i alone.
  BOULE_INLINE Vec3d one_sight(int i) const {
    const std::size_t at = first_ + static_cast<std::size_t>(i);
    return common == Common::direction ? origin_of(stream_.rays(), at) - shared_.org()
                                       : direction_of(stream_.rays(), at);
  }
  /// The sights of W rays, from `ray` on; likewise below.
  BOULE_INLINE Sight sight(int ray) const { return shared_.sight(packet(ray)); }
  template <Sought sought>
  BOULE_INLINE RealMask belongs(int ray) const {
    return shared_.template belongs<sought>(packet(ray));
  }
  BOULE_INLINE PacketStart start(int ray) const {
    const auto [rays, first] = packet(ray);
    const std::size_t at = rays->places(first).start;
    return {rays->tmax + first, rays->source + at, rays->inside + at};
  }
  /// The rays that the bits of `wanted` name, in memory; valid until the next call.
  BOULE_INLINE PacketRef packet(int ray, unsigned /*wanted*/ = all_lanes) const {
    return stream_.packet(first_ + static_cast<std::size_t>(ray));
  }
  /// Writes the rays with a hit, given as bits, to `answers`, which has a byte for each ray of the
  /// stream.
  BOULE_INLINE void answer(int ray, unsigned met, std::uint8_t* answers) const {
    std::uint8_t bytes[max_width];
    bytes_of(met, bytes);
    const std::size_t first = first_ + static_cast<std::size_t>(ray);
    if (live(ray) == width) {
      __builtin_memcpy(answers + first, bytes, width);
    } else {
      for (std::size_t lane = 0; lane < stream_.live(first); ++lane)
        answers[first + lane] = bytes[lane];
    }
  }
  /// The number of rays that are not copies of the stream's last ray.
  BOULE_INLINE int live(int ray) const {
    return static_cast<int>(stream_.live(first_ + static_cast<std::size_t>(ray)));
  }
  /// Prefetches the packet of the next bundle at the position of `ray` in this one.
  BOULE_INLINE void prefetch_next(int ray) const {
    prefetch_packet(stream_.rays(), first_ + static_cast<std::size_t>(ray + tuning::bundle_size));
  }

 private:
  const PaddedStream& stream_;
  std::size_t first_;
  int count_;
  SharedByRays<common> shared_;
};

}  // namespace boule::BOULE_KERNEL_ISA
