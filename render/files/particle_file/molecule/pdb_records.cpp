#include "render/files/particle_file/molecule/pdb_records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

/// A field of a line: columns from 0.
struct PdbField {
  const char* name;
  std::size_t begin, width;
};
constexpr std::array positions{PdbField{"x", 30, 8}, PdbField{"y", 38, 8}, PdbField{"z", 46, 8}};
constexpr std::size_t positions_end = 54;
constexpr PdbField occupancy{"occupancy", 54, 6}, b_factor{"bfactor", 60, 6};
constexpr std::array cell_fields{PdbField{"a", 6, 9},     PdbField{"b", 15, 9},
                                 PdbField{"c", 24, 9},    PdbField{"alpha", 33, 7},
                                 PdbField{"beta", 40, 7}, PdbField{"gamma", 47, 7}};

/// True for a name, in any case, at the start of the line.
bool is_record(std::string_view line, std::string_view name) {
  if (line.size() < name.size()) return false;
  return std::equal(name.begin(), name.end(), line.begin(), [](char expected, char c) {
    return c == expected || (c >= 'a' && c <= 'z' && c - 'a' + 'A' == expected);
  });
}

std::string_view field_text(std::string_view line, const PdbField& field) {
  return without_blanks(line.substr(std::min(field.begin, line.size()), field.width));
}

constexpr std::size_t width = 80, id_begin = 72, element_begin = 76, element_end = 78;

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
/// letters are no elements. A digit in the last column alone may be a charge.
bool has_line_number(std::string_view line) {
  const auto is_number = [&](std::size_t i) { return is_digit(line[i]) || line[i] == ' '; };
  return line.size() >= width && is_digit(line[id_begin]) && is_digit(line[79]) && is_number(78) &&
         std::all_of(line.begin() + id_begin, line.begin() + element_begin,
                     [](char c) { return is_digit(c) || is_letter(c); }) &&
         is_number(77);
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
  PdbFrameFinder(std::string_view text, bool is_cut) : text_(text), lines_(text), is_cut_(is_cut) {}

  Result<FramePlaces<PdbFrame>> run() {
    begin_frame();
    while (!lines_.at_end()) {
      const std::size_t offset = lines_.offset();
      const std::uint64_t number = lines_.line();
      const std::string_view line = lines_.next();
      if (is_pdb_atom(line)) {
        ++frame_.atoms;
        is_part_ = lines_.at_end() && line.size() < positions_end && !text_.ends_with('\n');
      } else if (is_record(line, "CRYST1")) {
        frame_.cell = offset;
        frame_.cell_line = number;
      } else if (is_record(line, "MODEL") || is_record(line, "END")) {
        finish_frame(offset);
        in_model_ = is_record(line, "MODEL");
      }
    }
    if (!find_cut()) finish_frame(lines_.offset());
    if (!found_.frames.empty()) return std::move(found_);
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
    if (frame_.atoms > 0) {
      found_.frames.push_back(frame_);
      are_alike_ = are_alike_ && frame_.atoms == found_.frames.front().atoms;
    }
    begin_frame();
  }

  /// Notes if what is left at the end of the file is a part of a frame.
  bool find_cut() {
    if (frame_.atoms == 0) return false;
    if (is_cut_) {
      found_.whole = error_at_line(lines_.line() - 1, "the file ends in it");
      return true;
    }
    if (found_.frames.empty()) return false;
    const std::uint64_t before = found_.frames.back().atoms;
    const bool is_trajectory = in_model_ || (are_alike_ && found_.frames.size() > 1);
    if (!is_part_ && !(is_trajectory && frame_.atoms < before)) return false;
    found_.whole = error_at_line(
        lines_.line() - 1, "the file ends after " + std::to_string(frame_.atoms) +
                               " of its atoms, the frame before has " + std::to_string(before));
    return true;
  }

  std::string_view text_;
  TextLines lines_;
  bool is_cut_;
  PdbFrame frame_;
  bool in_model_ = false;
  bool are_alike_ = true;  ///< frames have the same number of atoms
  bool is_part_ = false;   ///< the last record
  FramePlaces<PdbFrame> found_;
};

}  // namespace

Result<FramePlaces<PdbFrame>> find_pdb_frames(std::string_view text, bool is_cut) {
  return PdbFrameFinder(text, is_cut).run();
}

bool is_pdb_atom(std::string_view line) {
  return is_record(line, "ATOM") || is_record(line, "HETATM");
}

bool is_pdb_bond(std::string_view line) { return is_record(line, "CONECT"); }

Status add_pdb_record(std::string_view line, std::uint64_t line_number, const PdbFields& fields,
                      PdbRecords& records) {
  PdbRecords::Numbers numbers;
  const auto read = [&](const PdbField& field, double& target) -> Status {
    const auto number = number_of(line, line_number, field, field.name);
    if (!number) return number.error();
    target = number.value();
    return {};
  };
  if (auto done = read(positions[0], numbers.position.x); !done) return done;
  if (auto done = read(positions[1], numbers.position.y); !done) return done;
  if (auto done = read(positions[2], numbers.position.z); !done) return done;
  // May be missing, and blank.
  const auto read_factor = [&](bool is_wanted, const PdbField& field, double& target) -> Status {
    const std::string_view text = field_text(line, field);
    if (!is_wanted || text.empty()) return {};
    const auto number = number_in(text);
    const bool is_missing = number ? std::isnan(*number) : fields.lenient;
    if (!is_missing && !(number && fields.lenient)) return read(field, target);
    target = number.value_or(std::numeric_limits<double>::quiet_NaN());
    return {};
  };
  if (auto done = read_factor(fields.occupancy, occupancy, numbers.occupancy); !done) return done;
  if (auto done = read_factor(fields.b_factor, b_factor, numbers.b_factor); !done) return done;
  const std::size_t first = records.lines.size() + positions[0].begin;
  add_line(line, has_line_number(line) ? id_begin : element_end, records.lines);
  for (std::size_t i = element_begin; i < element_end; ++i) {  // a charge may stand there
    char& c = records.lines[records.lines.size() - 1 - width + i];
    if (!is_letter(c)) c = ' ';
  }
  const std::size_t count = b_factor.begin + b_factor.width - positions[0].begin;
  records.lines.replace(first, count, count, ' ');
  records.numbers.push_back(numbers);
  return {};
}

Result<std::string> pdb_cell_records(std::string_view text, std::uint64_t line_number) {
  TextLines lines(text);
  const std::string_view line = lines.next();
  constexpr PdbField all_edges{"CRYST1", 6, 27};
  if (field_text(line, all_edges).empty()) return std::string();
  std::array<double, 3> edges{};
  for (std::size_t i = 0; i < cell_fields.size(); ++i) {
    for (const double none : {0.0, 1.0}) {
      const bool has_edges = i == edges.size();
      if (has_edges && std::count(edges.begin(), edges.end(), none) == 3) return std::string();
    }
    const PdbField& field = cell_fields[i];
    const auto number = number_of(line, line_number, field, std::string("CRYST1.") + field.name);
    if (!number) return number.error();
    if (i < edges.size()) edges[i] = number.value();
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
