#pragma once

#include <cstdint>

namespace boule {

/// Bytes of memory that the system could give now without swapping, or that it has at all where it
/// does not tell; the largest number where neither is known.
std::uint64_t available_memory();

}  // namespace boule
