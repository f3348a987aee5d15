#include "render/particle_file/pdb_records.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/particle_file/text_lines.h"
#include "render/particle_file/text_number.h"

namespace boule {
namespace {

/// A field of a line: columns from 0.
struct PdbField {
  const char* name;
  std::size_t begin, width;
};
constexpr std::array positions{PdbField{"x", 30, 8}, PdbField{"y", 38, 8}, PdbField{"z", 46, 8}};
constexpr PdbField occupancy{"occupancy", 54, 6}, b_factor{"bfactor", 60, 6};
constexpr std::array cell_fields{PdbField{"a", 6, 9},     PdbField{"b", 15, 9},
                                 PdbField{"c", 24, 9},    PdbField{"alpha", 33, 7},
                                 PdbField{"beta", 40, 7}, PdbField{"gamma", 47, 7}};

/// True for a name of four letters at most, in any case, at the start of the line.
bool is_record(std::string_view line, std::string_view name) {
  if (line.size() < name.size()) return false;
  return std::equal(name.begin(), name.end(), line.begin(), [](char expected, char c) {
    return c == expected || (c >= 'a' && c <= 'z' && c - 'a' + 'A' == expected);
  });
}

std::string_view field_text(std::string_view line, const PdbField& field) {
  return without_blanks(line.substr(std::min(field.begin, line.size()), field.width));
}

constexpr std::size_t width = 80, id_begin = 72, element_end = 78;

/// Adds a line that has the first bytes of this one, blanks for what cannot be printed.
void add_line(std::string_view line, std::size_t bytes, std::string& records) {
  const std::size_t begin = records.size();
  records.resize(begin + width, ' ');
  records += '\n';
  for (std::size_t i = 0; i < std::min(line.size(), bytes); ++i) {
    const char c = line[i];
    records[begin + i] = c < ' ' || c > '~' ? ' ' : c;  // a byte above 127 may be negative
  }
}

/// True for lines of files from before 1996, which end with the entry's name and a number: their
/// letters are no elements.
bool has_line_number(std::string_view line) {
  return line.size() >= width && is_digit(line[79]) && (is_digit(line[78]) || line[78] == ' ');
}

Result<double> number_of(std::string_view line, std::uint64_t line_number, const PdbField& field,
                         const std::string& key) {
  const std::string_view text = field_text(line, field);
  if (text.empty()) {
    return error_at_word(line_number, line, line.substr(std::min(field.begin, line.size())),
                         "expected a number in columns " + std::to_string(field.begin + 1) +
                             " to " + std::to_string(field.begin + field.width) + ", found none",
                         key);
  }
  const auto number = number_in(text);
  // Other readers know no Fortran's D.
  if (!number || text.find_first_of("dD") != std::string_view::npos) {
    return error_at_word(line_number, line, text, "expected a number, found " + quote(text), key);
  }
  if (!std::isfinite(*number)) {
    return error_at_word(line_number, line, text, "expected a finite number, found " + quote(text),
                         key);
  }
  return *number;
}

class PdbFrameFinder {
 public:
  explicit PdbFrameFinder(std::string_view text) : lines_(text) {}

  Result<std::vector<PdbFrame>> run() {
    begin_frame();
    while (!lines_.at_end()) {
      const std::size_t offset = lines_.offset();
      const std::uint64_t number = lines_.line();
      const std::string_view line = lines_.next();
      if (is_pdb_atom(line)) {
        ++frame_.atoms;
      } else if (is_record(line, "CRYST1")) {
        frame_.cell = offset;
        frame_.cell_line = number;
      } else if (is_record(line, "MODEL") || is_record(line, "END")) {
        finish_frame(offset);
      }
    }
    finish_frame(lines_.offset());
    if (!frames_.empty()) return std::move(frames_);
    return Diagnostic::of("it holds no atoms: no record begins with ATOM or HETATM");
  }

 private:
  /// The next frame begins with the next line; a cell holds until there is another one.
  void begin_frame() {
    frame_.begin = lines_.offset();
    frame_.line = lines_.line();
    frame_.atoms = 0;
  }

  void finish_frame(std::size_t end) {
    frame_.end = end;
    if (frame_.atoms > 0) frames_.push_back(frame_);
    begin_frame();
  }

  TextLines lines_;
  PdbFrame frame_;
  std::vector<PdbFrame> frames_;
};

}  // namespace

Result<std::vector<PdbFrame>> find_pdb_frames(std::string_view text) {
  return PdbFrameFinder(text).run();
}

bool is_pdb_atom(std::string_view line) {
  return is_record(line, "ATOM") || is_record(line, "HETATM");
}

Status add_pdb_record(std::string_view line, std::uint64_t line_number, const PdbFields& fields,
                      PdbRecords& records) {
  PdbRecords::Numbers numbers;
  const auto read = [&](const PdbField& field, double& target) -> Status {
    const auto number = number_of(line, line_number, field, field.name);
    if (!number) return number.error();
    target = number.value();
    return std::nullopt;
  };
  if (auto wrong = read(positions[0], numbers.position.x)) return wrong;
  if (auto wrong = read(positions[1], numbers.position.y)) return wrong;
  if (auto wrong = read(positions[2], numbers.position.z)) return wrong;
  if (fields.occupancy && !field_text(line, occupancy).empty()) {
    if (auto wrong = read(occupancy, numbers.occupancy)) return wrong;
  }
  if (fields.b_factor && !field_text(line, b_factor).empty()) {
    if (auto wrong = read(b_factor, numbers.b_factor)) return wrong;
  }
  const std::size_t first = records.lines.size() + positions[0].begin;
  add_line(line, has_line_number(line) ? id_begin : element_end, records.lines);
  const std::size_t count = b_factor.begin + b_factor.width - positions[0].begin;
  records.lines.replace(first, count, count, ' ');
  records.numbers.push_back(numbers);
  return std::nullopt;
}

Result<std::string> pdb_cell_records(std::string_view text, std::uint64_t line_number) {
  TextLines lines(text);
  const std::string_view line = lines.next();
  constexpr PdbField all{"CRYST1", 6, 48};
  if (field_text(line, all).empty()) return std::string();
  std::array<double, 3> edges{};
  for (std::size_t i = 0; i < cell_fields.size(); ++i) {
    const PdbField& field = cell_fields[i];
    const auto number = number_of(line, line_number, field, std::string("CRYST1.") + field.name);
    if (!number) return number.error();
    if (i < edges.size()) edges[i] = number.value();
  }
  for (const double none : {0.0, 1.0}) {
    if (std::count(edges.begin(), edges.end(), none) == 3) return std::string();
  }
  std::string records;
  add_line(line, width, records);
  while (!lines.at_end() && !is_pdb_atom(lines.peek())) {
    const std::string_view next = lines.next();
    if (is_record(next, "SCALE")) add_line(next, width, records);
  }
  return records;
}

}  // namespace boule
