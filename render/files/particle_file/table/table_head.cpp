#include "render/files/particle_file/table/table_head.h"

#include <algorithm>
#include <array>
#include <utility>

#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particle_file/text/text_pieces.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

/// A line and where it is.
struct PlacedLine {
  std::string_view text;
  std::size_t begin = 0;
  std::uint64_t line = 0;
};

/// The first lines: some that are neither blank nor comments, and the last comment before them.
struct FirstLines {
  std::vector<PlacedLine> lines;
  std::string_view comment;
};

FirstLines first_lines(std::string_view text) {
  constexpr std::size_t enough = 10;
  FirstLines found;
  for (TextLines lines(text); !lines.at_end() && found.lines.size() < enough;) {
    PlacedLine next{{}, lines.offset(), lines.line()};
    next.text = lines.next();
    if (!is_table_gap(next.text)) {
      found.lines.push_back(next);
    } else if (found.lines.empty() && !words_of(next.text).empty()) {
      found.comment = next.text;
    }
  }
  return found;
}

std::string_view without_comment_mark(std::string_view line) {
  line = without_blanks(line);
  while (!line.empty() && (line.front() == '#' || line.front() == '/')) line.remove_prefix(1);
  return without_blanks(line);
}

/// What divides a table's lines into columns.
struct Separation {
  char separator = 0;       ///< as TableHead has it
  std::size_t columns = 0;  ///< between tabs: how many there are; else 0
  bool decimal_comma = false;
};

/// True for "0,5", "-1,25e3": a number whose only sign between digits is a comma.
bool has_decimal_comma(std::string_view text) {
  return std::count(text.begin(), text.end(), ',') == 1 && number_in(with_decimal_point(text)) &&
         text.find('.') == std::string_view::npos;
}

/// True if these texts, some of them at least, are numbers with a decimal comma, and none has a
/// point.
bool have_decimal_commas(const std::vector<std::vector<std::string_view>>& lines) {
  bool any = false;
  for (const auto& line : lines) {
    for (const std::string_view text : line) {
      if (text.find('.') != std::string_view::npos && number_in(text)) return false;
      any = any || has_decimal_comma(text);
    }
  }
  return any;
}

/// The columns of all of these lines.
std::vector<std::vector<std::string_view>> split_all(const std::vector<PlacedLine>& lines,
                                                     char separator) {
  std::vector<std::vector<std::string_view>> texts;
  texts.reserve(lines.size());
  for (const PlacedLine& line : lines) texts.push_back(split_table_line(line.text, separator));
  return texts;
}

/// True if blanks divide numbers with decimal commas: "0,5 1,0 2,25". The last line is a row.
bool is_of_blanks_and_commas(const std::vector<PlacedLine>& lines) {
  const auto row = split_table_line(lines.back().text, 0);
  return std::count_if(row.begin(), row.end(), has_decimal_comma) >= 2 && row.size() >= 3 &&
         std::all_of(row.begin(), row.end(), [](std::string_view text) {
           return number_in(with_decimal_point(text)).has_value();
         });
}

/// True if all lines have the same number of columns between these, three at least.
bool separates(char separator, const std::vector<PlacedLine>& lines) {
  const std::size_t count = split_table_line(lines.front().text, separator).size();
  return count >= 3 && std::all_of(lines.begin(), lines.end(), [&](const PlacedLine& line) {
           return split_table_line(line.text, separator).size() == count;
         });
}

/// How many columns lines have between tabs; 0 if they have different numbers of them. Tabs at the
/// end of a line, behind the last column that any line has, make no columns.
std::size_t count_tab_columns(const std::vector<std::vector<std::string_view>>& lines) {
  std::size_t columns = 0;
  for (const auto& line : lines) {
    const auto last = std::find_if(line.rbegin(), line.rend(), [](auto t) { return !t.empty(); });
    columns = std::max(columns, static_cast<std::size_t>(line.rend() - last));
  }
  const bool all_have_them = std::all_of(lines.begin(), lines.end(),
                                         [&](const auto& line) { return line.size() >= columns; });
  return all_have_them ? columns : 0;
}

/// True if tabs align the columns: where a line has no text, none of them has any. A blank in a
/// text tells that tabs separate.
bool are_aligned(const std::vector<std::vector<std::string_view>>& lines, std::size_t columns) {
  bool any_empty = false;
  for (std::size_t i = 0; i < columns; ++i) {
    for (const auto& line : lines) {
      if (line[i].find(' ') != std::string_view::npos) return false;
      if (line[i].empty() != lines.front()[i].empty()) return false;
    }
    any_empty = any_empty || lines.front()[i].empty();
  }
  return any_empty;
}

/// The columns between tabs; 0 if tabs are no separator.
std::size_t find_tab_columns(const std::vector<PlacedLine>& lines) {
  const auto texts = split_all(lines, '\t');
  const std::size_t columns = count_tab_columns(texts);
  return columns >= 3 && !are_aligned(texts, columns) ? columns : 0;
}

char separator_of(const std::vector<PlacedLine>& lines) {
  for (const char separator : {';', ','}) {
    if (separates(separator, lines)) return separator;
  }
  const auto count = [&](char separator) {
    return split_table_line(lines.front().text, separator).size();
  };
  for (const char separator : {';', ','}) {  // a row may be too short or too long
    if (count(separator) >= 3) return separator;
  }
  for (const char separator : {';', ','}) {  // a column may be missing
    if (count(separator) == 2 && count(0) < 3) return separator;
  }
  return 0;
}

Separation separation_of(const std::vector<PlacedLine>& lines) {
  Separation found;
  if (const std::size_t columns = find_tab_columns(lines)) {
    found = {'\t', columns};
  } else if (!is_of_blanks_and_commas(lines)) {
    found.separator = separator_of(lines);
  }
  if (found.separator == ',') return found;
  found.decimal_comma = have_decimal_commas(split_all(lines, found.separator));
  return found;
}

/// The columns of one of the first lines.
std::vector<std::string_view> columns_of(const PlacedLine& line, const Separation& separation) {
  auto columns = split_table_line(line.text, separation.separator);
  if (separation.columns != 0) columns.resize(separation.columns);
  return columns;
}

std::size_t count_numbers(const std::vector<std::string_view>& columns, bool decimal_comma) {
  const auto is_number = [&](std::string_view text) {
    return number_in(text) || (decimal_comma && has_decimal_comma(text));
  };
  return static_cast<std::size_t>(std::count_if(columns.begin(), columns.end(), is_number));
}

/// The names in a comment, if it has one for each of the columns: numpy.savetxt writes such.
std::vector<std::string> names_in_comment(std::string_view comment, char separator,
                                          std::size_t columns) {
  const std::string_view text = without_comment_mark(comment);
  for (const char between : {separator, ',', '\0'}) {
    const auto names = split_table_line(text, between);
    const auto has = [&](char axis) {
      return std::any_of(names.begin(), names.end(), [axis](std::string_view name) {
        return name.size() == 1 && (name[0] == axis || name[0] == axis - 'a' + 'A');
      });
    };
    if (names.size() != columns || !has('x') || !has('y') || !has('z')) continue;
    return {names.begin(), names.end()};
  }
  return {};
}

}  // namespace

std::vector<std::string_view> split_table_line(std::string_view line, char separator) {
  std::vector<std::string_view> columns;
  const auto is_between = [separator](char c) {
    return separator == 0 ? is_blank(c) : c == separator;
  };
  std::size_t i = 0;
  const auto skip_blanks = [&] {
    while (i < line.size() && is_blank(line[i]) && line[i] != separator) ++i;
  };
  skip_blanks();
  while (i < line.size() || (separator != 0 && !columns.empty())) {
    if (separator == 0 && line[i] == '#') break;  // a comment
    if (i < line.size() && line[i] == '"') {
      const std::size_t end = std::min(line.find('"', i + 1), line.size());
      columns.push_back(line.substr(i + 1, end - i - 1));
      i = std::min(end + 1, line.size());
      while (separator != 0 && i < line.size() && line[i] != separator) ++i;
    } else {
      const std::size_t begin = i;
      while (i < line.size() && !is_between(line[i])) ++i;
      columns.push_back(without_blanks(line.substr(begin, i - begin)));
    }
    if (separator != 0 && i == line.size()) break;
    if (separator != 0) ++i;
    skip_blanks();
  }
  return columns;
}

std::vector<std::string_view> example_texts(std::string_view text, const TableHead& head) {
  constexpr int enough = 1000;
  std::vector<std::string_view> examples = head.first_row;
  TextLines lines(text.substr(head.begin));
  for (int i = 0; i < enough && !lines.at_end(); ++i) {
    if (std::none_of(examples.begin(), examples.end(), is_missing_text)) break;
    const std::string_view line = lines.next();
    if (is_table_gap(line)) continue;
    const auto row = split_table_line(line, head.separator);
    for (std::size_t k = 0; k < std::min(row.size(), examples.size()); ++k) {
      if (is_missing_text(examples[k])) examples[k] = row[k];
    }
  }
  return examples;
}

Result<TableHead> parse_table_head(std::string_view text) {
  const FirstLines first = first_lines(text);
  if (first.lines.empty()) return Diagnostic::of("it holds no rows");
  TableHead head;
  const Separation separation = separation_of(first.lines);
  head.separator = separation.separator;
  head.decimal_comma = separation.decimal_comma;
  std::size_t row = 0;
  head.first_row = columns_of(first.lines[0], separation);
  if (head.first_row.size() > most_text_columns) {
    return error_at_line(first.lines[0].line, too_many_columns().message);
  }
  if (count_numbers(head.first_row, head.decimal_comma) < 3) {
    head.names.assign(head.first_row.begin(), head.first_row.end());
    head.names_line = first.lines[0].line;
    if (first.lines.size() == 1) {
      return error_at_line(first.lines[0].line, "no rows follow the line that names the columns");
    }
    row = 1;
    head.first_row = columns_of(first.lines[1], separation);
  } else {
    head.names = names_in_comment(first.comment, head.separator, head.first_row.size());
  }
  head.begin = first.lines[row].begin;
  head.line = first.lines[row].line;
  return head;
}

}  // namespace boule
