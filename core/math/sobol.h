#pragma once

#include <cstdint>

#include "core/base/platform.h"
#include "core/math/random.h"

namespace boule {

/// Two numbers in [0, 1), or two times W of them.
template <class T>
struct UnitPairOf {
  T u, v;
};
using UnitPair = UnitPairOf<double>;

/// Steps of sobol_point(), on digits of binary fractions: 32 of them in an integer, or in each of W
/// integers.
namespace detail {

template <class T>
BOULE_INLINE T reverse_bits(T x) {
  x = (x << 16) | (x >> 16);
  x = ((x & T(0x00ff00ffU)) << 8) | ((x >> 8) & T(0x00ff00ffU));
  x = ((x & T(0x0f0f0f0fU)) << 4) | ((x >> 4) & T(0x0f0f0f0fU));
  x = ((x & T(0x33333333U)) << 2) | ((x >> 2) & T(0x33333333U));
  return ((x & T(0x55555555U)) << 1) | ((x >> 1) & T(0x55555555U));
}

/// Each bit flipped by a hash of the bits below it: Owen's scrambling of a fraction whose digits
/// run from bit 0 on (Laine and Karras 2011; the constants are Vegdahl's, "Building a better LK
/// hash", 2021, which leave less structure).
template <class T>
BOULE_INLINE T scramble(T x, T seed) {
  x = x ^ x * T(0x3d20adeaU);
  x = x + seed;
  x = x * ((seed >> 16) | T(1U));
  x = x ^ x * T(0x05526c56U);
  return x ^ x * T(0x53a22864U);
}

/// Pascal's triangle modulo 2 times the bits of x: digits of the second Sobol dimension, the first
/// in bit 0. Digit i is the sum, modulo 2, of those bits j of x for which the number j has all the
/// binary digits of i (Lucas's theorem).
template <class T>
BOULE_INLINE T pascal(T x) {
  x = x ^ ((x >> 1) & T(0x55555555U));
  x = x ^ ((x >> 2) & T(0x33333333U));
  x = x ^ ((x >> 4) & T(0x0f0f0f0fU));
  x = x ^ ((x >> 8) & T(0x00ff00ffU));
  return x ^ (x >> 16);
}

}  // namespace detail

/// The uses of a sample's random numbers. Each use has its own set; those of the bounces count from
/// first_bounce on.
enum class RandomSet : std::uint32_t { film, lens, first_bounce };

/// A key for each pixel, from which all random numbers of the pixel follow. Different pixels, with
/// coordinates from 0 on, and different seeds of pictures have different keys. Any key is valid, 0
/// included.
class PixelKeys {
 public:
  explicit PixelKeys(std::uint64_t seed) : seed_(mix64(seed)) {}

  [[nodiscard]] std::uint64_t of(int x, int y) const {
    return mix64(seed_ + (static_cast<std::uint64_t>(y) << 32) + static_cast<std::uint64_t>(x));
  }

 private:
  std::uint64_t seed_;
};

/// The seeds that scramble the points of a pixel and a set.
template <class Integer>
struct SobolSeedsOf {
  Integer shuffle, u, v;
};
using SobolSeeds = SobolSeedsOf<std::uint32_t>;

inline SobolSeeds sobol_seeds(std::uint64_t key, RandomSet set) {
  const std::uint64_t seeds = mix64(key + static_cast<std::uint64_t>(set) * golden_step);
  const std::uint64_t more = mix64(seeds + golden_step);
  return {static_cast<std::uint32_t>(seeds), static_cast<std::uint32_t>(seeds >> 32),
          static_cast<std::uint32_t>(more)};
}

/// Point `sample` of the sequence with these seeds: see sobol_pair(). The integers are
/// std::uint32_t, or W of them at a time.
template <class Integer>
BOULE_INLINE auto sobol_point(const SobolSeedsOf<Integer>& seeds, Integer sample) {
  using detail::reverse_bits;  // lanes have their own
  const Integer index = reverse_bits(detail::scramble(reverse_bits(sample), seeds.shuffle));
  const Integer u = detail::scramble(index, seeds.u);
  const Integer v = detail::scramble(detail::pascal(index), seeds.v);
  using Number = decltype(unit_interval(u));
  return UnitPairOf<Number>{unit_interval(reverse_bits(u)), unit_interval(reverse_bits(v))};
}

/// Point `sample` of the Sobol (0, 2)-sequence, shuffled and Owen-scrambled anew for every pixel
/// and `set` (Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020). For any n, the
/// first n samples of a pixel have n 2^-(a+b) points, rounded up or down, in every rectangle of
/// 2^-a by 2^-b that tiles the unit square: samples are even in both directions and after any n.
/// One sample's points in two sets are independent (padding). The points of two samples are
/// slightly dependent: every shuffle keeps samples together whose numbers differ only in the last
/// bits. So a mean over several sets is right, but its error differs slightly from that of
/// independent sets, and a function of two sets converges about as with random numbers. The bits
/// are the same on every machine, in any order.
inline UnitPair sobol_pair(std::uint64_t key, RandomSet set, std::uint32_t sample) {
  return sobol_point(sobol_seeds(key, set), sample);
}

}  // namespace boule
