#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/scene_file/input_file.h"

namespace boule {

/// What the header of a .npy file declares (NumPy enhancement proposal 1).
struct NpyHeader {
  std::string descr;                 ///< element type: "<f4"
  bool fortran_order = false;        ///< columns first
  std::vector<std::uint64_t> shape;  ///< at most 8 dimensions
  std::uint64_t size = 0;            ///< bytes before the data
};

/// Parses the header's text, a Python dict with exactly these three keys; `size` stays 0. Errors
/// have a message only.
Result<NpyHeader> parse_npy_dict(std::string_view text);

/// Reads the header (format version 1.0, 2.0 or 3.0) and leaves `file` at the first element.
Result<NpyHeader> read_npy_header(InputFile& file);

}  // namespace boule
