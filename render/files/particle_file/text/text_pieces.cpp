#include "render/files/particle_file/text/text_pieces.h"

#include <algorithm>
#include <cstdint>

#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

/// For each piece the numbers that its own numbers of texts become.
std::vector<std::vector<std::uint32_t>> renumbering(std::span<const TextPiece> pieces,
                                                    std::size_t interner, TextColumn& column,
                                                    const MappedText* file) {
  TextInterner all;
  std::vector<std::vector<std::uint32_t>> renumbered(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const std::string_view text : pieces[i].interners[interner].texts()) {
      renumbered[i].push_back(all.index_of(text));
    }
    if (file != nullptr) file->let_go(pieces[i].text);  // where the texts are that it has first
  }
  column.texts.assign(all.texts().begin(), all.texts().end());
  return renumbered;
}

/// Cuts a text at ends of lines. `file` as cut_rows() has it.
std::vector<std::string_view> cut_lines(std::string_view text, const MappedText* file) {
  constexpr std::size_t piece_size = std::size_t{1} << 20;
  std::vector<std::string_view> pieces;
  while (!text.empty()) {
    const std::size_t end = text.size() <= piece_size ? text.size() : text.find('\n', piece_size);
    const std::size_t size = std::min(end == std::string_view::npos ? end : end + 1, text.size());
    pieces.push_back(text.substr(0, size));
    text.remove_prefix(size);
    if (file != nullptr) file->let_go(pieces.back());
  }
  return pieces;
}

/// Lines of a piece, and how many of them are rows.
struct LineCounts {
  std::uint64_t lines = 0, rows = 0;
};

LineCounts count_lines(std::string_view text, RowLines lines) {
  LineCounts counts;
  if (lines == RowLines::every) {
    counts.lines = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
    counts.rows = counts.lines;
    return counts;
  }
  for (std::size_t at = 0; at < text.size(); ++counts.lines) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (!is_table_gap(text.substr(at, end - at))) ++counts.rows;
    at = end + 1;
  }
  return counts;
}

std::vector<LineCounts> count_all_lines(std::span<const std::string_view> pieces, RowLines lines,
                                        const ParallelFor& parallel_for, const MappedText* file) {
  std::vector<LineCounts> counts(pieces.size());
  parallel_for(pieces.size(), [&](std::size_t i) {
    counts[i] = count_lines(pieces[i], lines);
    if (file != nullptr) file->let_go(pieces[i]);
  });
  return counts;
}

}  // namespace

bool is_table_gap(std::string_view line) {
  std::size_t i = 0;
  while (i < line.size() && is_blank(line[i])) ++i;
  const std::string_view rest = line.substr(i);
  return rest.empty() || rest.front() == '#' || rest.starts_with("//");
}

std::uint64_t count_table_rows(std::string_view text, const ParallelFor& parallel_for,
                               const MappedText* file) {
  std::uint64_t rows = 0;
  for (const LineCounts& counts :
       count_all_lines(cut_lines(text, file), RowLines::table, parallel_for, file)) {
    rows += counts.rows;
  }
  return rows;
}

std::vector<TextPiece> cut_rows(std::string_view rows, std::size_t interners,
                                const ParallelFor& parallel_for, RowLines lines,
                                const MappedText* file) {
  const std::vector<std::string_view> texts = cut_lines(rows, file);
  std::vector<LineCounts> counts(texts.size());
  if (texts.size() > 1) counts = count_all_lines(texts, lines, parallel_for, file);
  std::vector<TextPiece> pieces;
  LineCounts before;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    TextPiece& piece = pieces.emplace_back();
    piece.text = texts[i];
    piece.first_row = static_cast<std::size_t>(before.rows);
    piece.first_line = before.lines;
    piece.interners.resize(interners);
    before.rows += counts[i].rows;
    before.lines += counts[i].lines;
  }
  return pieces;
}

Status check_pieces(std::span<const TextPiece> pieces, std::size_t rows) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!pieces[i].status) return pieces[i].status;
    const std::size_t next = i + 1 < pieces.size() ? pieces[i + 1].first_row : rows;
    if (pieces[i].end_row != std::max(pieces[i].first_row, std::min(next, rows))) {
      return Diagnostic::of("the file has been changed since it was opened");
    }
  }
  return {};
}

void merge_texts(std::span<const TextPiece> pieces, std::size_t interner, TextColumn& column,
                 const ParallelFor& parallel_for, const MappedText* file) {
  const auto renumbered = renumbering(pieces, interner, column, file);
  parallel_for(pieces.size(), [&](std::size_t i) {
    if (renumbered[i].empty()) return;               // no row of it was read
    const std::size_t rows = column.indices.size();  // the pieces may have more
    const std::size_t end = i + 1 < pieces.size() ? std::min(pieces[i + 1].first_row, rows) : rows;
    for (std::size_t row = pieces[i].first_row; row < end; ++row) {
      column.indices[row] = renumbered[i][column.indices[row]];
    }
  });
}

}  // namespace boule
