#pragma once

#include <cstdint>

namespace boule {

/// The coverage of a sample is a whole number: 0 of a miss, this of a hit, less of a hit in fog.
inline constexpr std::uint8_t whole_coverage = 255;

/// The most samples of a pixel whose sum of coverages fits into 32 bits.
inline constexpr int most_covered_samples = 16843009;

}  // namespace boule
