#pragma once

#include <array>
#include <cstdint>

namespace boule {

/// Philox4x32-10, a counter-based generator (Salmon, Moraes, Dror, Shaw, "Parallel random numbers:
/// as easy as 1, 2, 3", SC 2011). The same counter and key give the same four words on every
/// machine, in any order, on any thread. The functions of this file take any numbers.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                           std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53u} * counter[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {
        static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
        static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key = {key[0] + 0x9E3779B9u, key[1] + 0xBB67AE85u};
  }
  return counter;
}

/// The finalizer of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014): 64 bits to 64 others, one to one. A cheaper hash than philox().
inline std::uint64_t mix64(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// 2^64 divided by the golden ratio: the step between counters that mix64() hashes.
inline constexpr std::uint64_t golden_step = 0x9e3779b97f4a7c15u;

/// The largest double below 1.
inline constexpr double below_one = 1 - 0x1p-53;

/// 32 random bits as a double in [0, 1).
inline double unit_interval(std::uint32_t bits) { return bits * 0x1p-32; }

}  // namespace boule
