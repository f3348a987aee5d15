#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace boule {

/// The number whose bytes begin there, in any alignment, whatever the machine's order of bytes.
template <class T>
T load_number(const char* bytes, bool is_big_endian) {
  using Bits = std::conditional_t<
      sizeof(T) == 8, std::uint64_t,
      std::conditional_t<sizeof(T) == 4, std::uint32_t,
                         std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t at = is_big_endian ? sizeof(T) - 1 - i : i;
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[at])} << (8 * i);
  }
  return std::bit_cast<T>(static_cast<Bits>(bits));
}

}  // namespace boule
