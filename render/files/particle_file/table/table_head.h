#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace boule {

/// What the first lines of a table tell.
struct TableHead {
  char separator = 0;              ///< ',', ';', a tab, or 0 for blanks
  bool decimal_comma = false;      ///< the numbers have one
  std::vector<std::string> names;  ///< of the columns, as the header line has them; else empty
  std::uint64_t names_line = 0;    ///< of the header line, if there is one
  std::vector<std::string_view> first_row;  ///< its columns, without quotes
  std::size_t begin = 0;                    ///< first byte of the first row's line
  std::uint64_t line = 1;                   ///< of the first row
};

/// Looks at the start of a table: which separator its lines have in common, whether its numbers
/// have decimal commas, and whether its first line, or the comment before its first row, names the
/// columns. Errors: no rows, or more than
/// 4096 columns.
Result<TableHead> parse_table_head(std::string_view text);

/// For each column its text in the first row, or in the first of the next thousand rows where it is
/// not missing. They are views of the text.
std::vector<std::string_view> example_texts(std::string_view text, const TableHead& head);

/// The columns of a line of a table, without their quotes. They are views of the line.
std::vector<std::string_view> split_table_line(std::string_view line, char separator);

}  // namespace boule
