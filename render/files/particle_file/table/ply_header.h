#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/table/binary_table.h"

namespace boule {

/// A type of PLY: "float", "uint8".
struct PlyType {
  BinaryKind kind = BinaryKind::real;
  std::size_t width = 0;  ///< bytes
};

/// A property of an element: a value, or a list of values behind their count.
struct PlyProperty {
  std::string name;
  PlyType type;                  ///< of the value or of each value of the list
  std::optional<PlyType> count;  ///< of lists only
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::uint64_t line = 0;  ///< of the file, that declares it
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_lists() const;
  /// The bytes of one, without those of its lists.
  [[nodiscard]] std::size_t fixed_bytes() const;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

/// The header of a PLY file (G. Turk, The PLY polygon file format, 1994).
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;  ///< in the order of their data
  std::size_t bytes = 0;             ///< of the header
  std::uint64_t lines = 0;           ///< of the header
};

/// Parses the header at the start of a file's bytes. Lines end with "\n" or "\r\n". Errors have
/// line, column, and the statement as their key.
Result<PlyHeader> parse_ply_header(std::string_view bytes);

}  // namespace boule
