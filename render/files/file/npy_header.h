#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/file/input_file.h"

namespace boule {

/// A named field of a structured element type: `count` values after each other.
struct NpyField {
  std::string name;   ///< empty for bytes that fill a gap
  std::string descr;  ///< the type of a value: "<f4"
  std::uint64_t count = 1;
};

/// What the header of a .npy file declares (NumPy enhancement proposal 1).
struct NpyHeader {
  std::string descr;                 ///< element type: "<f4"; empty if it has fields
  std::vector<NpyField> fields;      ///< of a structured element type, in their order
  bool fortran_order = false;        ///< columns first
  std::vector<std::uint64_t> shape;  ///< at most 8 dimensions
  std::uint64_t size = 0;            ///< bytes before the data
};

/// Parses the header's text, a Python dict with exactly these three keys; `size` stays 0. Errors
/// have a message only.
Result<NpyHeader> parse_npy_dict(std::string_view text);

/// The header at the start of the bytes of a whole .npy file.
Result<NpyHeader> parse_npy_header(std::string_view bytes);

/// Reads the header (format version 1.0, 2.0 or 3.0) and leaves `file` at the first element.
Result<NpyHeader> read_npy_header(InputFile& file);

}  // namespace boule
