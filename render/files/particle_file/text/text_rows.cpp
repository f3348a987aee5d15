#include "render/files/particle_file/text/text_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/float_environment.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particle_file/text/text_pieces.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

/// Where a column of numbers goes: by row, `stride` apart.
struct NumberTarget {
  double* first = nullptr;
  std::size_t stride = 1;
};

/// A column as the loop over rows needs it.
struct PlannedColumn {
  ColumnUse use = ColumnUse::skipped;
  NumberTarget numbers;
  std::uint32_t* texts = nullptr;
  std::size_t interner = 0;
  bool positive = false;
};

bool is_text(ColumnUse use) { return use == ColumnUse::species || use == ColumnUse::text; }

TextColumn& text_column(const TextRowColumn& column, ParticleFrame& frame) {
  return column.use == ColumnUse::species ? *frame.species : frame.texts[column.index];
}

/// Makes room in `frame`; the plan's pointers go there.
std::vector<PlannedColumn> plan(const TextRows& source, std::span<const TextRowColumn> columns,
                                ParticleFrame& frame) {
  const std::size_t rows = source.rows;
  std::vector<PlannedColumn> planned;
  std::size_t interners = 0;
  for (const TextRowColumn& column : columns) {
    PlannedColumn next;
    next.use = column.use;
    next.positive = !source.positive.empty() && column.name == source.positive;
    if (column.use == ColumnUse::position) {
      frame.positions.resize(rows);
      Vec3d& first = frame.positions.front();
      next.numbers = {column.index == 0 ? &first.x : column.index == 1 ? &first.y : &first.z, 3};
    } else if (column.use == ColumnUse::number || column.use == ColumnUse::logical) {
      frame.numbers[column.index].values.resize(rows);
      next.numbers = {frame.numbers[column.index].values.data(), 1};
    } else if (is_text(column.use)) {
      TextColumn& texts = text_column(column, frame);
      texts.indices.resize(rows);
      next.texts = texts.indices.data();
      next.interner = interners++;
    }
    planned.push_back(next);
  }
  return planned;
}

Status check_room(std::size_t rows, std::span<const TextRowColumn> columns) {
  std::uint64_t bytes = 0;
  for (const TextRowColumn& column : columns) {
    if (column.use != ColumnUse::skipped) bytes += is_text(column.use) ? 4 : 8;
  }
  return check_memory(bytes * rows, std::to_string(rows) + " particles need");
}

/// Where the line ends that `at` is in.
const char* line_end(const char* at, const char* end) {
  const void* const found = std::memchr(at, '\n', static_cast<std::size_t>(end - at));
  return found == nullptr ? end : static_cast<const char*>(found);
}

/// A column's text in a row, without its quotes and the blanks behind it.
struct RowToken {
  std::string_view text;
  const char* end;  ///< of what it takes in the row
};

/// Tables may have gaps, quotes and a separator; other rows are read without asking for them.
template <bool is_table>
class PieceReader {
 public:
  PieceReader(const TextRows& rows, std::span<const TextRowColumn> columns,
              std::span<const PlannedColumn> planned, TextPiece& piece)
      : rows_(rows),
        columns_(columns),
        planned_(planned),
        piece_(piece),
        at_(piece.text.data()),
        end_(at_ + piece.text.size()),
        separator_(rows.separator) {}

  /// Reads all rows, up to the first that is wrong.
  void read() {
    line_number_ = rows_.first_line + piece_.first_line;
    for (row_ = piece_.first_row; row_ < rows_.rows; ++row_, ++line_number_) {
      if (is_table && !rows_.is_flow) skip_gaps();
      if (at_ == end_) break;
      line_ = at_;
      if (!read_row()) return;
    }
    piece_.end_row = row_;
  }

 private:
  char separator() const { return is_table ? separator_ : '\0'; }
  bool ends_flow(char c) const { return is_table && rows_.is_flow && c == ']'; }

  bool at_row_end() const {
    return at_ == end_ || *at_ == '\n' || (rows_.comments && *at_ == '#') || ends_flow(*at_);
  }

  /// True for what ends a number.
  bool ends_token(const char* at) const {
    return at == end_ || is_blank(*at) || *at == '\n' || ends_flow(*at) ||
           (separator() != 0 && *at == separator());
  }

  void skip_blanks() {
    while (at_ < end_ && is_blank(*at_) && *at_ != separator()) ++at_;
  }

  void skip_gaps() {
    while (at_ < end_) {
      const char* const stop = line_end(at_, end_);
      if (!is_table_gap({at_, static_cast<std::size_t>(stop - at_)})) return;
      at_ = stop == end_ ? end_ : stop + 1;
      ++line_number_;
    }
  }

  RowToken token() const {
    if (is_table && at_ < end_ && (*at_ == '"' || (rows_.is_flow && *at_ == '\''))) {
      const char* stop = at_ + 1;
      while (stop < end_ && *stop != *at_ && *stop != '\n') ++stop;
      const std::string_view text(at_ + 1, static_cast<std::size_t>(stop - at_ - 1));
      return {text, stop < end_ && *stop == *at_ ? stop + 1 : stop};
    }
    const char* stop = at_;
    const auto ends = [&](char c) {
      return c == '\n' || ends_flow(c) || (separator() == 0 ? is_blank(c) : c == separator());
    };
    while (stop < end_ && !ends(*stop)) ++stop;
    const char* last = stop;
    while (last > at_ && is_blank(last[-1])) --last;
    return {{at_, static_cast<std::size_t>(last - at_)}, stop};
  }

  /// Goes to the text of column `i`, which the row must have.
  bool go_to_column(std::size_t i) {
    skip_blanks();
    if (at_row_end()) {
      return fail(i, "the row ends before this column, expected " +
                         std::to_string(planned_.size()) + " columns");
    }
    if (separator() == 0 || i == 0) return true;
    if (*at_ != separator()) {
      const std::string expected = separator() == '\t' ? "a tab" : quote({&separator_, 1});
      return fail(i, "expected " + expected + ", found " + quote(token().text));
    }
    ++at_;
    skip_blanks();
    return true;
  }

  bool read_row() {
    if (is_table && rows_.is_flow && !(takes('-') && takes('['))) return false;
    for (std::size_t i = 0; i < planned_.size(); ++i) {
      if (!go_to_column(i) || !read_column(i)) return false;
    }
    skip_blanks();
    if (separator() == '\t') skip_tabs();
    if (is_table && rows_.is_flow && !end_flow()) return false;
    if (!at_row_end()) return fail_beyond_columns();
    while (at_ < end_ && *at_ != '\n') ++at_;  // a comment
    if (at_ < end_) ++at_;
    return true;
  }

  /// Goes on behind a mark of YAML, which must come next.
  bool takes(char mark) {
    skip_blanks();
    if (at_ == end_ || *at_ != mark) {
      return fail(planned_.size(), "expected " + quote({&mark, 1}) + ", found " +
                                       quote({at_, at_ < end_ && *at_ != '\n' ? 1U : 0U}));
    }
    ++at_;
    return true;
  }

  /// A comma may stand behind the last column.
  bool end_flow() {
    const char* const behind = at_;
    if (at_ < end_ && *at_ == separator()) ++at_;
    skip_blanks();
    if (!at_row_end()) at_ = behind;  // a column too many
    if (!at_row_end()) return fail_beyond_columns();
    if (!takes(']')) return false;
    skip_blanks();
    return true;
  }

  /// Tabs behind the last column make no columns.
  void skip_tabs() {
    const char* at = at_;
    while (at < end_ && is_blank(*at)) ++at;
    if (at == end_ || *at == '\n') at_ = at;
  }

  /// Names the first column that a row has too many.
  bool fail_beyond_columns() {
    if (separator() != 0 && *at_ == separator()) ++at_;
    skip_blanks();
    const std::string_view text = token().text;
    return fail(planned_.size(), "the row goes on with " +
                                     (text.empty() ? "an empty column" : quote(text)) +
                                     ", expected " + std::to_string(planned_.size()) + " columns");
  }

  bool read_column(std::size_t i) {
    const PlannedColumn& column = planned_[i];
    if (column.use == ColumnUse::number || column.use == ColumnUse::position) {
      return column.positive ? read_positive_number(i) : read_number(i);
    }
    const RowToken read = token();
    if (column.use == ColumnUse::logical) {
      auto value = logical_in(read.text);
      if (!value && rows_.lenient) value = std::numeric_limits<double>::quiet_NaN();
      if (!value) return fail(i, "expected T or F, found " + quote(read.text));
      column.numbers.first[row_ * column.numbers.stride] = *value;
    } else if (is_text(column.use)) {
      column.texts[row_] = piece_.interners[column.interner].index_of(read.text);
    }
    at_ = read.end;
    return true;
  }

  bool read_number(std::size_t i) {
    const NumberTarget& target = planned_[i].numbers;
    double& value = target.first[row_ * target.stride];
    const bool has_comma = is_table && rows_.decimal_comma;
    const char* const stop = has_comma ? nullptr : number_at(at_, end_, value);
    if (stop != nullptr && ends_token(stop)) {
      at_ = stop;
      return true;
    }
    const RowToken read = token();
    const auto number = has_comma ? number_with_comma(read.text) : number_in(read.text);
    if (!may_be(i, number, read.text)) {
      const std::string expected =
          !number ? has_comma ? "a number with a decimal comma" : "a number" : "a finite number";
      return fail(i, "expected " + expected + ", found " + quote(read.text));
    }
    value = number.value_or(std::numeric_limits<double>::quiet_NaN());
    at_ = read.end;
    return true;
  }

  static std::optional<double> number_with_comma(std::string_view text) {
    if (text.find('.') != std::string_view::npos) return std::nullopt;
    return number_in(with_decimal_point(text));
  }

  /// True for what column `i` can hold: a finite number or, but for positions, a missing one.
  bool may_be(std::size_t i, const std::optional<double>& number, std::string_view text) const {
    if (number && std::isfinite(*number)) return true;
    if (planned_[i].use == ColumnUse::position) return false;
    return rows_.lenient || (number ? std::isnan(*number) : is_table && is_missing_text(text));
  }

  bool read_positive_number(std::size_t i) {
    const char* const begin = at_;
    const std::string_view text = token().text;
    if (!read_number(i)) return false;
    const NumberTarget& target = planned_[i].numbers;
    if (target.first[row_ * target.stride] > 0) return true;
    at_ = begin;
    return fail(i, "expected a number above 0, found " + quote(text));
  }

  bool fail(std::size_t column, std::string message) {
    const std::string key = column < columns_.size() ? columns_[column].name : std::string();
    piece_.status = Diagnostic{.message = std::move(message),
                               .key = key,
                               .line = place_number(line_number_),
                               .column = place_number(static_cast<std::uint64_t>(at_ - line_) + 1)};
    return false;
  }

  const TextRows& rows_;
  std::span<const TextRowColumn> columns_;
  std::span<const PlannedColumn> planned_;
  TextPiece& piece_;
  const char* at_;
  const char* const end_;
  const char separator_;
  const char* line_ = nullptr;
  std::uint64_t line_number_ = 0;
  std::size_t row_ = 0;
};

}  // namespace

Status read_text_rows(const TextRows& rows, std::span<const TextRowColumn> columns,
                      ParticleFrame& frame, const ParallelFor& parallel_for) {
  if (rows.rows == 0) return {};
  if (auto room = check_room(rows.rows, columns); !room) return room;
  const auto interners = static_cast<std::size_t>(std::count_if(
      columns.begin(), columns.end(), [](const TextRowColumn& c) { return is_text(c.use); }));
  const RowLines lines = rows.is_table && !rows.is_flow ? RowLines::table : RowLines::every;
  std::vector<TextPiece> pieces = cut_rows(rows.text, interners, parallel_for, lines, rows.file);
  const std::vector<PlannedColumn> planned = plan(rows, columns, frame);
  parallel_for(pieces.size(), [&](std::size_t i) {
    const FloatEnvironment environment;
    if (rows.is_table) {
      PieceReader<true>(rows, columns, planned, pieces[i]).read();
    } else {
      PieceReader<false>(rows, columns, planned, pieces[i]).read();
    }
    if (rows.file != nullptr) rows.file->let_go(pieces[i].text);
  });
  if (auto done = check_pieces(pieces, rows.rows); !done) return done;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!is_text(columns[i].use)) continue;
    merge_texts(pieces, planned[i].interner, text_column(columns[i], frame), parallel_for,
                rows.file);
  }
  return {};
}

TextRowColumn add_number_column(ParticleFrame& frame, const std::string& name, ColumnUse use) {
  frame.numbers.push_back({name, {}});
  return {name, use, frame.numbers.size() - 1};
}

TextRowColumn add_text_column(ParticleFrame& frame, const std::string& name) {
  frame.texts.push_back({name, {}, {}});
  return {name, ColumnUse::text, frame.texts.size() - 1};
}

}  // namespace boule
