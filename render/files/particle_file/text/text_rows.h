#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/file/mapped_text.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// What becomes of a column of a text file.
enum class ColumnUse {
  skipped,
  position,  ///< `index` is the axis
  number,    ///< `index` is that in ParticleFrame::numbers
  logical,   ///< the same; "T" is 1 and "F" is 0
  species,
  text,  ///< `index` is that in ParticleFrame::texts
};

/// So many columns a row has at most: each takes memory before any row is read.
constexpr std::size_t most_text_columns = 4096;
inline Diagnostic too_many_columns() {
  return Diagnostic::of("it has more than " + std::to_string(most_text_columns) + " columns");
}

/// A column of rows of text.
struct TextRowColumn {
  std::string name;  ///< as errors name it
  ColumnUse use = ColumnUse::skipped;
  std::size_t index = 0;
};

/// Lines of a file, each a row with the same columns.
struct TextRows {
  std::string_view text;         ///< begins with the first row; what follows the last is ignored
  std::size_t rows = 0;          ///< as many lines as there are at least
  std::uint64_t first_line = 1;  ///< in the file, from 1
  bool comments = false;         ///< '#' and what follows it is no part of the row
  /// Lines between the rows may be blank or comments ("#", "//"), and a text in double quotes is
  /// one column. `rows` are then those of count_table_rows().
  bool is_table = false;
  /// Of tables: what stands between columns, beside blanks around it; 0: blanks alone.
  char separator = 0;
  /// Of tables: each line is a flow sequence of YAML, "- [ 1, 2, 'C', ]", without gaps between.
  bool is_flow = false;
  /// Of tables: numbers have a decimal comma, never a point.
  bool decimal_comma = false;
  bool lenient = false;  ///< as ParticleFileOptions
  std::string_view
      positive{};  ///< the name of a column of numbers that must be above 0; empty: none
  const MappedText* file = nullptr;  ///< holds the text, and lets go of what is read; null: neither
};

/// Reads rows into the columns of `frame`: makes room for all that `columns` names, refusing what
/// does not fit into memory, and fills it. Errors have the line, the column, and the name of the
/// column as their key: a row that is too short or too long, what is no number, and what is not
/// finite. NaN, and in tables an empty text, "null" and the like, is a missing number in all
/// columns but the positions. The numbers are the nearest doubles.
Status read_text_rows(const TextRows& rows, std::span<const TextRowColumn> columns,
                      ParticleFrame& frame, const ParallelFor& parallel_for);

/// Adds a column to `frame`, empty so far, and returns what reads it.
TextRowColumn add_number_column(ParticleFrame& frame, const std::string& name,
                                ColumnUse use = ColumnUse::number);
TextRowColumn add_text_column(ParticleFrame& frame, const std::string& name);

}  // namespace boule
