#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/error.h"
#include "render/files/particle_file/table/binary_table.h"
#include "render/files/particle_file/table/ply_header.h"

namespace boule {

/// Where the data of a file's points is.
struct PlyVertices {
  std::size_t element = 0;  ///< "vertex" in the header
  BinaryTable table;        ///< its columns; offsets are for binary files only
  std::size_t begin = 0;    ///< first byte of the points' data,
  std::size_t end = 0;      ///< which ends before this byte
  std::uint64_t line = 0;   ///< of ascii files: the line of the first point
};

/// Finds the points behind all elements that come before them. Errors: no element "vertex", no
/// columns for positions, lists among its properties, and a file that ends before its last point.
Result<PlyVertices> find_ply_vertices(std::string_view bytes, const PlyHeader& header);

}  // namespace boule
