#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/file/mapped_text.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particle_file/text/text_interner.h"

namespace boule {

/// Some of the rows of a text, in one piece: what one call of a parallel loop reads.
struct TextPiece {
  std::string_view text;                ///< whole lines
  std::size_t first_row = 0;            ///< of all rows, from 0
  std::uint64_t first_line = 0;         ///< of all lines, from 0
  std::size_t end_row = 0;              ///< behind the last row that was read
  std::vector<TextInterner> interners;  ///< one for each column of texts
  Status status;
};

/// Which lines are rows: all, or those of a table, where lines may be blank or comments.
enum class RowLines { every, table };

/// True if a line of a table is blank, or a comment: "#" or "//" comes first.
bool is_table_gap(std::string_view line);

/// The rows of a table. `file` holds the text, if it is not null: what is read is let go.
std::uint64_t count_table_rows(std::string_view text, const ParallelFor& parallel_for,
                               const MappedText* file = nullptr);

/// Cuts rows, a line each, at ends of lines. There is at least one piece unless `rows` is empty.
/// `file` as above.
std::vector<TextPiece> cut_rows(std::string_view rows, std::size_t interners,
                                const ParallelFor& parallel_for, RowLines lines = RowLines::every,
                                const MappedText* file = nullptr);

/// The first piece's error; an error, too, if a piece has other rows than when they were counted.
/// `rows` is how many were asked for.
Status check_pieces(std::span<const TextPiece> pieces, std::size_t rows);

/// Gives `column` the texts of all pieces, in the order of their first use. Its indices, so far
/// those of each piece's own interner, change to match. `file` as above.
void merge_texts(std::span<const TextPiece> pieces, std::size_t interner, TextColumn& column,
                 const ParallelFor& parallel_for, const MappedText* file = nullptr);

}  // namespace boule
