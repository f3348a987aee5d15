#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_reader.h"

namespace boule {

/// The kinds of values that columns are made of: floats, integers with and without a sign,
/// booleans, texts of bytes and texts of 32-bit characters.
enum class BinaryKind { real, integer, unsigned_integer, boolean, bytes, characters };

/// One column of a binary table: a value in every row.
struct BinaryColumn {
  std::string name;
  BinaryKind kind = BinaryKind::real;
  std::size_t width = 0;   ///< bytes of a value; 2, 4 or 8 of floats, 1, 2, 4 or 8 of integers
  std::size_t offset = 0;  ///< bytes from the start of the row
  bool is_big_endian = false;
  double divisor = 1;  ///< numbers are divided by it

  [[nodiscard]] bool is_text() const {
    return kind == BinaryKind::bytes || kind == BinaryKind::characters;
  }
};

/// Rows of values of a fixed width.
struct BinaryTable {
  std::vector<BinaryColumn> columns;
  std::size_t row_bytes = 0;
  std::size_t rows = 0;
};

/// Nothing if each name occurs once and there is a column of numbers for each of x, y, z; else a
/// message, and the name as its key.
Status check_binary_columns(const BinaryTable& table);

/// Reads `table.rows` rows, which begin at `first_row`, in any alignment. The columns are kept
/// under their names, texts called "element", "species" or "symbol" as the species; of the others
/// only those in `options.wanted`, if there is such a list. Errors: a number that is not finite,
/// with the column's name as key, unless it is missing (NaN) and no position; what does not fit
/// into memory. Precondition: check_binary_columns() has passed the table.
Result<ParticleFrame> read_binary_table(const BinaryTable& table, const char* first_row,
                                        const ParticleFileOptions& options,
                                        const ParallelFor& parallel_for);

}  // namespace boule
