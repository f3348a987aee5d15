#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/frame/other_formats.h"
#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/table/table_reader.h"
#include "render/files/particle_file/table/xyz_comment.h"
#include "render/files/particle_file/text/frame_places.h"
#include "render/files/particle_file/text/named_columns.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

/// Where a frame is in the text.
struct XyzFrame {
  std::size_t comment = 0;     ///< first byte of the second line
  std::size_t begin = 0;       ///< of the rows,
  std::size_t end = 0;         ///< which end before this byte
  std::uint64_t count = 0;     ///< of rows
  std::uint64_t row_line = 0;  ///< line of the first row
};

/// Skips so many lines, or as many as there are, and returns how many. What is behind is let go.
std::uint64_t skip_rows(std::uint64_t count, TextLines& lines, const MappedText& bytes) {
  constexpr std::uint64_t portion = std::uint64_t{1} << 16;
  std::uint64_t skipped = 0;
  while (skipped < count) {
    const std::size_t begin = lines.offset();
    const std::uint64_t more = lines.skip(std::min(portion, count - skipped));
    if (more == 0) break;
    skipped += more;
    bytes.let_go(bytes.text().substr(begin, lines.offset() - begin));
  }
  return skipped;
}

/// What is wrong with a frame at the end of the file: it lacks rows, or a part of its last one.
Status find_cut(const XyzFrame& frame, std::uint64_t rows, std::string_view text,
                const std::vector<XyzFrame>& before) {
  const std::string promise = "it promises " + std::to_string(frame.count) + " particles, ";
  if (rows < frame.count || frame.begin == frame.comment) {
    return Diagnostic::of(promise + "the file ends after " + std::to_string(rows));
  }
  if (before.empty()) return {};  // its rows are read, and tell what is wrong
  const std::string_view own = text.substr(frame.begin, frame.end - frame.begin);
  const std::size_t like = rows > 1 ? frame.begin : before.back().begin;
  if (!has_cut_row(own, TextLines(text.substr(like)).next())) return {};
  return Diagnostic::of(promise + "the file ends in the last of them");
}

Result<FramePlaces<XyzFrame>> find_xyz_frames(const MappedText& bytes) {
  FramePlaces<XyzFrame> found;
  const std::string_view text = bytes.text();
  TextLines lines(text);
  for (lines.skip_blank_lines(); !lines.at_end(); lines.skip_blank_lines()) {
    const std::uint64_t first_line = lines.line();
    const std::string_view line = lines.next();
    const auto count = count_in(without_blanks(line));
    if (!count) {
      return error_at_line(first_line, "expected a count of particles, found " + quote(line),
                           "count");
    }
    XyzFrame frame{.comment = lines.offset(), .count = *count};
    lines.skip(1);
    frame.begin = lines.offset();
    frame.row_line = lines.line();
    const std::uint64_t rows = skip_rows(*count, lines, bytes);
    frame.end = lines.offset();
    if (auto whole = lines.at_end() ? find_cut(frame, rows, text, found.frames) : Status();
        !whole) {
      found.whole = error_at_line(first_line, whole.error().message, "count");
      break;
    }
    if (auto done = add_frame_place(found.frames, frame); !done) return done.error();
  }
  if (!found.frames.empty()) return found;
  return found.whole ? Diagnostic::of("it holds no frames") : found.whole.error();
}

bool is_velocity(const std::string& name) {
  constexpr std::array names{"vel", "velo", "velocity", "velocities"};
  return std::count(names.begin(), names.end(), name) > 0;
}

/// The names of the columns that a property of several columns has.
std::vector<std::string> names_of(const XyzProperty& property) {
  if (property.count == 1) return {property.name};
  if (property.count == 3 && is_velocity(property.name)) return {"vx", "vy", "vz"};
  if (property.count == 3 && property.name == "color") return {"red", "green", "blue"};
  std::vector<std::string> names;
  constexpr std::array axes{"_x", "_y", "_z"};
  for (std::size_t i = 0; i < property.count; ++i) {
    names.push_back(property.name +
                    (property.count == 3 ? std::string(axes[i]) : "_" + std::to_string(i + 1)));
  }
  return names;
}

/// True for atomic numbers, as ASE and QUIP write them.
bool is_atomic_number(const XyzProperty& property) {
  constexpr std::array names{"Z", "numbers"};
  return property.count == 1 && property.type == 'I' &&
         (is_atomic_number_name(property.name) ||
          std::count(names.begin(), names.end(), property.name) > 0);
}

bool is_species(const XyzProperty& property) {
  constexpr std::array names{"species", "element", "symbol", "symbols"};
  return property.type == 'S' && property.count == 1 &&
         std::count(names.begin(), names.end(), property.name) > 0;
}

void add_property(const XyzProperty& property, NamedColumns& columns) {
  constexpr std::array axes{"x", "y", "z"};
  if (is_species(property)) return columns.add_species(property.name);
  if (property.count == 3 && (property.name == "pos" || property.name == "positions")) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns.add_position(property.name + "_" + axes[axis], axis);
    }
    return;
  }
  for (std::size_t axis = 0; property.count == 1 && axis < 3; ++axis) {
    if (property.name == axes[axis]) return columns.add_position(property.name, axis);
  }
  const ColumnUse use = property.type == 'S'   ? ColumnUse::text
                        : property.type == 'L' ? ColumnUse::logical
                                               : ColumnUse::number;
  for (const std::string& name : names_of(property)) columns.add_kept(name, use);
}

class XyzReader : public PlacedReader<XyzFrame> {
 public:
  XyzReader(MappedText bytes, ParticleFileOptions options, FramePlaces<XyzFrame> places)
      : PlacedReader(std::move(bytes), std::move(options), std::move(places)) {
    has_numbers_ = has_atomic_numbers();
  }

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor& parallel_for) override {
    const XyzFrame& place = places_.frames[frame];
    const std::string_view text = bytes_.text();
    auto comment = parse_xyz_comment(TextLines(text.substr(place.comment)).next());
    if (!comment) {
      Diagnostic error = comment.error();
      error.line = place_number(place.row_line - 1);
      return error;
    }
    ParticleFrame read;
    read.cell = comment.value().cell;
    read.axes_matter = read.cell.has_value();
    read.time = comment.value().time;
    const std::string_view rows = text.substr(place.begin, place.end - place.begin);
    NamedColumns columns(options_.wanted, read);
    if (auto done = plan(comment.value(), TextLines(rows).next(), columns); !done) {
      done.error().line = place_number(place.row_line);
      return done.error();
    }
    if (auto done = columns.check_positions(); !done) {
      done.error().line = place_number(place.row_line - 1);
      return done.error();
    }
    const TextRows source{.text = rows,
                          .rows = static_cast<std::size_t>(place.count),
                          .first_line = place.row_line,
                          .lenient = options_.lenient,
                          .positive = options_.positive,
                          .file = &bytes_};
    if (auto done = read_text_rows(source, columns.columns(), read, parallel_for); !done)
      return done.error();
    columns.finish();
    name_elements(comment.value(), read);
    return read;
  }

 private:
  /// Makes atomic numbers elements.
  void name_elements(const XyzComment& comment, ParticleFrame& read) const {
    if (!read.species || !options_.columns.empty()) return;
    const auto& all = comment.properties;
    const bool by_name = std::any_of(all.begin(), all.end(), [&](const XyzProperty& property) {
      return property.name == read.species->name && is_atomic_number(property);
    });
    if (!by_name && !has_numbers_) return;
    if (!take_atomic_numbers(*read.species) || by_name) return;
    read.notes.emplace_back(
        "the species are taken as atomic numbers; columns named type,x,y,z make them types");
  }

  Status plan(const XyzComment& comment, std::string_view first_row, NamedColumns& columns) const {
    const auto& all = comment.properties;
    const bool tells_species = std::any_of(all.begin(), all.end(), is_species);
    for (const XyzProperty& property : all) {
      if (!tells_species && is_atomic_number(property)) {
        columns.add_species(property.name);
      } else {
        add_property(property, columns);
      }
    }
    if (!comment.properties.empty()) return {};
    const auto words = words_of(first_row);
    if (words.size() > most_text_columns) return too_many_columns();
    const std::size_t count = std::max<std::size_t>(words.size(), words.size() == 3 ? 3 : 4);
    std::vector<std::string> names = options_.columns;
    if (names.empty()) {
      names = {"species", "x", "y", "z"};
      if (count == 3) names.erase(names.begin());
      for (std::size_t i = names.size(); i < count; ++i) names.push_back("c" + std::to_string(i));
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
      columns.add(names[i], i < words.size() ? words[i] : std::string_view("0"));
    }
    return {};
  }

  /// True if the first words of the first frame's rows are atomic numbers. Types are numbered from
  /// 1 on without a gap; so they are in what LAMMPS writes ("Atoms. Timestep: 0") even with gaps.
  [[nodiscard]] bool has_atomic_numbers() const {
    const auto has_rows = [](const XyzFrame& frame) { return frame.count > 0; };
    const auto& all = places_.frames;
    const auto first = std::find_if(all.begin(), all.end(), has_rows);
    if (first == all.end()) return false;
    const std::string_view text = bytes_.text();
    if (TextLines(text.substr(first->comment)).next().starts_with("Atoms")) return false;
    std::array<bool, last_element + 1> occurs{};
    TextLines lines(text.substr(first->begin, first->end - first->begin));
    while (!lines.at_end()) {
      const std::string_view row = without_blanks(lines.next());
      const auto number = count_in(row.substr(0, row.find_first_of(" \t")));
      if (!number || *number > last_element) return false;
      occurs[static_cast<std::size_t>(*number)] = true;
    }
    const auto kinds = std::count(occurs.begin(), occurs.end(), true);
    const auto end = std::min<std::ptrdiff_t>(kinds + 1, last_element + 1);
    return std::count(occurs.begin() + 1, occurs.begin() + end, true) < kinds;
  }

  bool has_numbers_ = false;  ///< in place of the species
};

/// A row of Tinker: "1 O 0.0 0.0 0.0 1 2 3", number, name, position, type, bonds.
bool is_tinker_row(std::string_view line) {
  const auto words = words_of(line);
  return words.size() >= 6 && words[0] == "1" && !number_in(words[1]) && number_in(words[2]) &&
         number_in(words[3]) && number_in(words[4]) && count_in(words[5]);
}

/// What Tinker calls .xyz: a count and a title in one line, perhaps a box, and its rows.
bool is_of_tinker(TextLines lines) {
  const auto words = words_of(lines.next());
  if (words.empty() || !count_in(words.front())) return false;
  return is_tinker_row(lines.next()) || is_tinker_row(lines.next());
}

/// The reader of a file that does not begin with a count, if it is one of points.
Result<std::unique_ptr<ParticleReader>> open_without_count(MappedText bytes,
                                                           const ParticleFileOptions& options,
                                                           const ParallelFor& parallel_for,
                                                           const TextLines& lines) {
  if (!bytes.whole()) return bytes.whole().error();  // nobody knows how many points there were
  if (looks_like_points(bytes.text())) return open_points(std::move(bytes), options, parallel_for);
  return error_at_line(lines.line(), "expected a count of particles, found " + quote(lines.peek()),
                       "count");
}

Result<std::unique_ptr<ParticleReader>> open_xyz(MappedText bytes,
                                                 const ParticleFileOptions& options,
                                                 const ParallelFor& parallel_for) {
  TextLines lines(bytes.text());
  lines.skip_blank_lines();
  if (is_of_tinker(lines)) {
    return error_at_line(lines.line(),
                         "it is of Tinker, whose .xyz files are not read" + advice_for("a.txyz"));
  }
  if (!lines.at_end() && !count_in(without_blanks(lines.peek()))) {
    return open_without_count(std::move(bytes), options, parallel_for, lines);
  }
  return placed_reader<XyzReader>(find_xyz_frames(bytes), std::move(bytes), options);
}

/// A count, a comment, and a row of a name and three numbers.
bool starts_like_xyz(std::string_view start) {
  TextLines lines(start);
  const auto count = count_in(without_blanks(lines.next()));
  lines.next();
  if (!count || *count == 0 || lines.at_end()) return false;
  const auto words = words_of(lines.next());
  return words.size() >= 4 && number_in(words[1]) && number_in(words[2]) && number_in(words[3]);
}

}  // namespace

constinit const ParticleFormat xyz_format = {.name = "xyz",
                                             .endings = {"xyz", "extxyz"},
                                             .starts_like = starts_like_xyz,
                                             .open = open_xyz,
                                             .is_trajectory = true};

}  // namespace boule
