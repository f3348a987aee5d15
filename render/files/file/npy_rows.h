#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "core/base/error.h"
#include "render/files/file/input_file.h"
#include "render/files/file/npy_header.h"

namespace boule {

/// What readers of .npy files with rows of numbers share. Errors have a message only, except those
/// of the system.

/// "(3, 4)".
std::string npy_shape_text(const NpyHeader& header);

/// Refuses numbers other than little-endian float32 and float64, and Fortran order.
Status check_npy_elements(const NpyHeader& header);

/// True if the numbers are float64. Precondition: check_npy_elements() has passed them.
inline bool npy_is_double(const NpyHeader& header) { return header.descr == "<f8"; }

/// Refuses a file of `file_size` bytes unless it is exactly as long as its header and shape[0] rows
/// of `row_bytes` bytes each.
Status check_npy_length(const NpyHeader& header, std::size_t row_bytes, std::uint64_t file_size);

/// Reads the next `bytes` bytes of rows. It is an error if the file has become shorter.
Status read_npy_rows(InputFile& file, unsigned char* rows, std::size_t bytes);
/// The same from byte `begin` of the file on. Several threads may do so at the same time.
Status read_npy_rows(const InputFile& file, std::uint64_t begin, unsigned char* rows,
                     std::size_t bytes);

/// One little-endian float or double, whatever the machine's byte order. On little-endian machines
/// compilers make it a single load.
template <class Number>
inline Number npy_number(const unsigned char* bytes) {
  using Bits = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
  static_assert(sizeof(Number) == sizeof(Bits));
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof bits; ++i) bits |= Bits{bytes[i]} << (8 * i);
  return std::bit_cast<Number>(bits);
}

/// The same of a number of `width` bytes: 4, a float, or 8.
inline double npy_number_of(const unsigned char* bytes, std::size_t width) {
  return width == 8 ? npy_number<double>(bytes) : double{npy_number<float>(bytes)};
}

}  // namespace boule
