#include "render/files/particle_file/lammps/yaml_dump.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/files/particle_file/lammps/dump_columns.h"
#include "render/files/particle_file/lammps/dump_places.h"
#include "render/files/particle_file/lammps/lammps_box.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"

namespace boule {
namespace {

/// What stands above the rows of a frame.
struct YamlHead {
  std::optional<ParticleCell> cell;
  std::optional<double> time, length_in_angstrom;
  std::optional<std::uint64_t> atoms;
  std::vector<std::string> names;
  std::uint64_t names_line = 0;
};

bool begins_document(std::string_view line) { return line.starts_with("---"); }
bool ends_document(std::string_view line) { return line.starts_with("..."); }
bool is_nested(std::string_view line) {
  return line.starts_with(' ') || (line.starts_with('-') && !begins_document(line));
}

/// The parts of "[ a, b, 'c', ]", views of the line; none if it has no brackets.
std::optional<std::vector<std::string_view>> list_in(std::string_view line) {
  const std::size_t open = line.find('['), close = line.rfind(']');
  if (open == line.npos || close == line.npos || close < open) return std::nullopt;
  std::string_view rest = line.substr(open + 1, close - open - 1);
  std::vector<std::string_view> parts;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    std::string_view part = without_blanks(rest.substr(0, end));
    const bool is_quoted = part.size() > 1 && part.front() == part.back() &&
                           (part.front() == '\'' || part.front() == '"');
    if (is_quoted) part = part.substr(1, part.size() - 2);
    if (!part.empty() || end < rest.size()) parts.push_back(part);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return parts;
}

/// Reads what stands above a frame's rows: behind it, `lines` is at the first row.
class YamlHeadReader {
 public:
  explicit YamlHeadReader(TextLines& lines) : lines_(lines) {}

  Result<YamlHead> read() {
    bool is_data = false;
    for (lines_.skip_blank_lines(); !is_data && !lines_.at_end();) {
      number_ = lines_.line();
      line_ = lines_.next();
      if (begins_document(line_) || line_.starts_with('#') || without_blanks(line_).empty())
        continue;
      const std::size_t colon = line_.find(':');
      if (ends_document(line_)) return error_at_line(number_, "the frame ends here without data");
      if (is_nested(line_) || colon == line_.npos) {
        return error_at_line(number_, "expected a key and ':', found " + quote(line_));
      }
      key_ = line_.substr(0, colon);
      is_data = key_ == "data";
      if (auto done = is_data ? Status() : take(without_blanks(line_.substr(colon + 1))); !done)
        return done.error();
    }
    if (!is_data) return error_at_line(lines_.line(), "the file ends in the head of a frame");
    if (!head_.atoms) return error_at_line(number_, "the frame has no natoms above", "natoms");
    if (head_.names.empty()) {
      return error_at_line(
          number_, "the frame has no keywords above, as in keywords: [ id, x, y, z ]", "keywords");
    }
    if (head_.cell && periodic_) head_.cell->periodic = *periodic_;
    return std::move(head_);
  }

 private:
  Status take(std::string_view value) {
    if (key_ == "natoms") return take_count(value);
    if (key_ == "units") return take_units(value);
    if (key_ == "time") return take_number(value, head_.time.emplace());
    if (key_ == "boundary") return take_boundary();
    if (key_ == "keywords") return take_names();
    if (key_ == "box") return take_box();
    while (!lines_.at_end() && is_nested(lines_.peek())) lines_.skip(1);
    return {};
  }

  /// An error at a word of the line, or about the line.
  Diagnostic wrong(std::string_view word, const std::string& expected) const {
    if (word.empty()) word = line_;
    return error_at_word(number_, line_, word, "expected " + expected + ", found " + quote(word),
                         std::string(key_));
  }

  Status take_count(std::string_view value) {
    head_.atoms = count_in(value);
    return head_.atoms ? Status() : wrong(value, "a count of atoms");
  }

  Status take_units(std::string_view value) {
    if (!is_lammps_units(value))
      return wrong(value, "lj, real, metal, si, cgs, electron, micro or nano");
    head_.length_in_angstrom = lammps_length_in_angstrom(value);
    return {};
  }

  Status take_number(std::string_view value, double& to) const {
    const auto number = number_in(value);
    if (!number || !std::isfinite(*number)) return wrong(value, "a finite number");
    to = *number;
    return {};
  }

  Status take_boundary() {
    const auto list = list_in(line_);
    if (!list || list->size() != 6) return wrong({}, "six boundaries, as in [ p, p, f, f, p, p ]");
    auto& periodic = periodic_.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) periodic[axis] = (*list)[2 * axis] == "p";
    return {};
  }

  Status take_names() {
    const auto list = list_in(line_);
    if (!list || list->empty()) return wrong({}, "names of columns, as in [ id, x, y, z ]");
    if (list->size() > most_text_columns) {
      return error_at_line(number_, too_many_columns().message, std::string(key_));
    }
    head_.names.assign(list->begin(), list->end());
    head_.names_line = number_;
    return {};
  }

  /// Three lists of two bounds and, of a tilted box, one of its tilts.
  Status take_box() {
    const std::uint64_t first = lines_.line();
    LammpsBox box;
    if (auto done = take_box_line({&box.lo.x, &box.hi.x}); !done) return done;
    if (auto done = take_box_line({&box.lo.y, &box.hi.y}); !done) return done;
    if (auto done = take_box_line({&box.lo.z, &box.hi.z}); !done) return done;
    if (is_nested(lines_.peek())) {
      if (auto done = take_box_line({&box.xy, &box.xz, &box.yz}); !done) return done;
      box = box_in_bounds(box);
    }
    auto cell = cell_of_dump(box, first);
    if (!cell) return cell.error();
    head_.cell = cell.value();
    return {};
  }

  Status take_box_line(std::initializer_list<double*> numbers) {
    number_ = lines_.line();
    line_ = lines_.next();
    const auto list = list_in(line_);
    if (!is_nested(line_) || !list || list->size() != numbers.size()) {
      return wrong({}, "a list of " + std::to_string(numbers.size()) + " numbers");
    }
    auto word = list->begin();
    for (double* const number : numbers) {
      if (auto done = take_number(*word++, *number); !done) return done;
    }
    return {};
  }

  TextLines& lines_;
  YamlHead head_;
  std::optional<std::array<bool, 3>> periodic_;
  std::uint64_t number_ = 0;  ///< of the line that is read
  std::string_view line_, key_;
};

/// Goes through a frame; leaves `lines` behind it.
Result<YamlHead> skip_frame(TextLines& lines, std::string_view text) {
  auto head = YamlHeadReader(lines).read();
  if (!head) return head;
  const std::uint64_t first = lines.line(), atoms = *head.value().atoms;
  const std::size_t begin = lines.offset();
  const std::uint64_t rows = lines.skip(atoms);
  const std::string_view read = text.substr(begin, lines.offset() - begin);
  if (rows != atoms) {
    return error_at_line(first - 1,
                         "natoms promises " + std::to_string(atoms) +
                             " rows, the file ends after " + std::to_string(rows),
                         "natoms");
  }
  if (!read.empty() && read.back() != '\n' && read.find(']', read.rfind('\n') + 1) == read.npos)
    return error_at_line(lines.line() - 1, "the file ends in the last row of its data");
  const std::uint64_t number = lines.line();
  const std::string_view line = lines.peek();
  if (ends_document(line)) lines.skip(1);
  const bool is_end = without_blanks(line).empty() || ends_document(line) ||
                      begins_document(line) || line.starts_with("creator:");
  if (is_end) return head;
  lines.skip(1);
  if (lines.at_end() && text.back() != '\n' && std::string_view("...").starts_with(line))
    return head;
  return error_at_line(number, "expected the end of the frame, ..., found " + quote(line),
                       "natoms");
}

Result<DumpPlaces> find_yaml_frames(std::string_view text) {
  TextLines lines(text);
  DumpPlaces found;
  std::optional<double> length;
  for (lines.skip_blank_lines(); !lines.at_end(); lines.skip_blank_lines()) {
    const DumpPlace place{lines.offset(), lines.line()};
    const auto head = skip_frame(lines, text);
    if (!head && lines.at_end() && !found.frames.empty()) {
      found.whole = head.error();
      break;
    }
    if (!head) return head.error();
    if (!length) length = head.value().length_in_angstrom;
    if (auto done = add_frame_place(found.frames, place); !done) return done.error();
  }
  if (found.frames.empty()) return error_at_line(lines.line(), "it has no frame");
  found.length_in_angstrom = length.value_or(1);
  return found;
}

class YamlDumpReader : public PlacedReader<DumpPlace> {
 public:
  YamlDumpReader(MappedText bytes, ParticleFileOptions options, DumpPlaces places)
      : PlacedReader(std::move(bytes), std::move(options), places),
        length_in_angstrom_(places.length_in_angstrom) {}

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor& parallel_for) override {
    const DumpPlace& place = places_.frames[frame];
    const std::string_view text = bytes_.text().substr(place.begin);
    TextLines lines(text, place.line);
    auto head = YamlHeadReader(lines).read();
    if (!head) return head.error();
    ParticleFrame read;
    read.length_in_angstrom = length_in_angstrom_;
    read.cell = head.value().cell;
    read.time = head.value().time;
    const std::uint64_t first_line = lines.line();
    const std::size_t begin = lines.offset();
    const std::uint64_t rows = lines.skip(*head.value().atoms);
    const TextRows source{.text = text.substr(begin, lines.offset() - begin),
                          .rows = static_cast<std::size_t>(rows),
                          .first_line = first_line,
                          .is_table = true,
                          .separator = ',',
                          .is_flow = true,
                          .lenient = options_.lenient,
                          .positive = options_.positive,
                          .file = &bytes_};
    const auto& names = options_.columns.empty() ? head.value().names : options_.columns;
    const auto examples = list_in(TextLines(source.text).next());
    DumpColumns columns(names, examples.value_or(std::vector<std::string_view>()), options_, read);
    if (auto done = columns.read(source, head.value().names_line, parallel_for); !done)
      return done.error();
    return read;
  }

 private:
  double length_in_angstrom_;
};

}  // namespace

bool starts_like_yaml_dump(std::string_view start) {
  TextLines lines(start);
  lines.skip_blank_lines();
  if (begins_document(lines.peek())) lines.skip(1);
  return lines.peek().starts_with("creator: LAMMPS");
}

Result<std::unique_ptr<ParticleReader>> open_yaml_dump(MappedText bytes,
                                                       const ParticleFileOptions& options) {
  return placed_reader<YamlDumpReader>(find_yaml_frames(bytes.text()), std::move(bytes), options);
}

}  // namespace boule
