#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/math/geometry.h"
#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/lammps/dump_frames.h"
#include "render/files/particle_file/lammps/id_order.h"
#include "render/files/particle_file/lammps/lammps_box.h"
#include "render/files/particle_file/text/named_columns.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

/// The numbers of a line; an error if there are more, fewer, or others than finite ones.
Result<std::vector<double>> numbers_of(std::string_view line, std::uint64_t line_number,
                                       std::size_t count, const std::string& key) {
  const auto words = words_of(line);
  std::vector<double> numbers;
  for (const std::string_view word : words) {
    const auto number = number_in(word);
    if (!number || !std::isfinite(*number)) {
      return error_at_word(line_number, line, word,
                           "expected a finite number, found " + quote(word), key);
    }
    numbers.push_back(*number);
  }
  if (numbers.size() == count) return numbers;
  return error_at_line(
      line_number,
      "expected " + std::to_string(count) + " numbers, found " + std::to_string(numbers.size()),
      key);
}

/// What "ITEM: BOX BOUNDS ..." and the three lines below it say.
class BoxReader {
 public:
  explicit BoxReader(std::string_view text, const DumpSection& section)
      : words_(words_of(TextLines(text.substr(section.header)).next())),
        lines_(text.substr(section.begin)),
        first_line_(section.line) {
    // ITEM: BOX BOUNDS, unless the file has been overwritten since it was opened
    words_.erase(words_.begin(), words_.begin() + std::min<std::ptrdiff_t>(3, std::ssize(words_)));
  }

  Result<ParticleCell> read() {
    const bool tilted = takes({"xy", "xz", "yz"});
    const bool general = !tilted && takes({"abc", "origin"});
    std::array<std::vector<double>, 3> rows;
    for (std::size_t i = 0; i < 3; ++i) {
      auto row = numbers_of(lines_.next(), first_line_ + i,
                            general  ? 4
                            : tilted ? 3
                                     : 2,
                            "BOX BOUNDS");
      if (!row) return row.error();
      rows[i] = std::move(row).value();
    }
    ParticleCell cell;
    if (general) {
      cell = general_cell(rows);
    } else {
      const LammpsBox box = box_of(rows, tilted);
      if (const auto axis = negative_axis(box)) {
        return error_at_line(first_line_ + static_cast<std::uint64_t>(axis->front() - 'x'),
                             "the box has a negative length along " + *axis, "BOX BOUNDS");
      }
      cell = cell_of(box);
    }
    if (!is_finite(cell)) {
      return error_at_line(first_line_, "the box is larger than the largest number", "BOX BOUNDS");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      cell.periodic[i] = words_.size() < 3 || words_[i].starts_with('p');
    }
    return cell;
  }

 private:
  /// True if the header goes on with these words, which are then taken.
  bool takes(std::initializer_list<std::string_view> expected) {
    if (words_.size() < expected.size()) return false;
    if (!std::equal(expected.begin(), expected.end(), words_.begin())) return false;
    words_.erase(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(expected.size()));
    return true;
  }

  static ParticleCell general_cell(const std::array<std::vector<double>, 3>& rows) {
    ParticleCell cell;
    cell.a = {rows[0][0], rows[0][1], rows[0][2]};
    cell.b = {rows[1][0], rows[1][1], rows[1][2]};
    cell.c = {rows[2][0], rows[2][1], rows[2][2]};
    cell.origin = {rows[0][3], rows[1][3], rows[2][3]};
    return cell;
  }

  static LammpsBox box_of(const std::array<std::vector<double>, 3>& rows, bool tilted) {
    LammpsBox box{.lo = {rows[0][0], rows[1][0], rows[2][0]},
                  .hi = {rows[0][1], rows[1][1], rows[2][1]}};
    if (!tilted) return box;
    box.xy = rows[0][2], box.xz = rows[1][2], box.yz = rows[2][2];
    return box_in_bounds(box);
  }

  std::vector<std::string_view> words_;
  TextLines lines_;
  std::uint64_t first_line_;
};

/// The columns that a dump's positions are in.
struct DumpPositions {
  std::array<std::string, 3> names;
  std::array<bool, 3> scaled{};

  [[nodiscard]] bool any_scaled() const { return scaled[0] || scaled[1] || scaled[2]; }
  [[nodiscard]] bool all_scaled() const { return scaled[0] && scaled[1] && scaled[2]; }
};

/// For each axis: x, else xs (a fraction of the box), else xu (unwrapped), else xsu.
DumpPositions find_positions(const std::vector<std::string>& names) {
  DumpPositions found;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    found.names[axis] = std::string(1, static_cast<char>('x' + axis));
    for (const char* suffix : {"", "s", "u", "su"}) {
      const std::string name = static_cast<char>('x' + axis) + std::string(suffix);
      if (std::count(names.begin(), names.end(), name) == 0) continue;
      found.names[axis] = name;
      found.scaled[axis] = *suffix == 's';
      break;
    }
  }
  return found;
}

/// Makes positions of fractions of the cell.
void unscale(const DumpPositions& positions, const ParticleCell& cell, std::vector<Vec3d>& points) {
  const Vec3d o = cell.origin, a = cell.a, b = cell.b, c = cell.c;
  if (positions.all_scaled()) {
    for (Vec3d& p : points) p = o + a * p.x + b * p.y + c * p.z;
    return;
  }
  for (Vec3d& p : points) {
    if (positions.scaled[0]) p.x = o.x + a.x * p.x;
    if (positions.scaled[1]) p.y = o.y + b.y * p.y;
    if (positions.scaled[2]) p.z = o.z + c.z * p.z;
  }
}

bool is_upright(const ParticleCell& cell) {
  return cell.a.y == 0 && cell.a.z == 0 && cell.b.x == 0 && cell.b.z == 0 && cell.c.x == 0 &&
         cell.c.y == 0;
}

class DumpReader : public PlacedReader<DumpFramePlace> {
 public:
  DumpReader(MappedText bytes, ParticleFileOptions options, FramePlaces<DumpFramePlace> places,
             double length_in_angstrom)
      : PlacedReader(std::move(bytes), std::move(options), std::move(places)),
        length_in_angstrom_(length_in_angstrom) {}

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor& parallel_for) override {
    const DumpFramePlace& place = places_.frames[frame];
    ParticleFrame read;
    if (auto done = read_header(place, read); !done) return done.error();
    const DumpSection& atoms = place.atoms;
    const std::string_view rows = bytes_.text().substr(atoms.begin, atoms.end - atoms.begin);
    const auto names = column_names(atoms);
    if (!names) return names.error();
    const DumpPositions positions = find_positions(names.value());
    NamedColumns columns(options_.wanted, read);
    add_columns(names.value(), positions, words_of(TextLines(rows).next()), columns);
    if (auto done = columns.check_positions(); !done) {
      return error_at_line(atoms.line - 1, done.error().message, done.error().key);
    }
    const TextRows source{.text = rows,
                          .rows = static_cast<std::size_t>(atoms.rows),
                          .first_line = atoms.line,
                          .lenient = options_.lenient,
                          .positive = options_.positive,
                          .file = &bytes_};
    if (auto done = read_text_rows(source, columns.columns(), read, parallel_for); !done)
      return done.error();
    if (positions.any_scaled()) {
      if (auto done = check_scaled(positions, read, atoms.line - 1); !done) return done.error();
      unscale(positions, *read.cell, read.positions);
      if (auto done = check_finite(read, atoms); !done) return done.error();
    }
    if (auto done = sort_by_id(read, atoms.line, parallel_for); !done) return done.error();
    columns.finish();
    return read;
  }

 private:
  Status read_header(const DumpFramePlace& place, ParticleFrame& read) const {
    read.length_in_angstrom = length_in_angstrom_;
    if (place.box.exists()) {
      auto cell = BoxReader(bytes_.text(), place.box).read();
      if (!cell) return cell.error();
      read.cell = cell.value();
    }
    if (!place.time.exists()) return {};
    const auto time = numbers_of(TextLines(bytes_.text().substr(place.time.begin)).next(),
                                 place.time.line, 1, "TIME");
    if (!time) return time.error();
    read.time = time.value().front();
    return {};
  }

  [[nodiscard]] Result<std::vector<std::string>> column_names(const DumpSection& atoms) const {
    if (!options_.columns.empty()) return options_.columns;
    const auto words = words_of(TextLines(bytes_.text().substr(atoms.header)).next());
    if (words.size() > most_text_columns) {
      return error_at_line(atoms.line - 1, too_many_columns().message);
    }
    if (words.size() > 2) return std::vector<std::string>(words.begin() + 2, words.end());
    return error_at_line(atoms.line - 1,
                         "it does not name its columns, as in ITEM: ATOMS id type x y z");
  }

  static void add_columns(const std::vector<std::string>& names, const DumpPositions& positions,
                          const std::vector<std::string_view>& examples, NamedColumns& columns) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto axis = std::find(positions.names.begin(), positions.names.end(), names[i]);
      if (axis != positions.names.end()) {
        columns.add_position(names[i], static_cast<std::size_t>(axis - positions.names.begin()));
      } else {
        columns.add(names[i], examples, i);
      }
    }
  }

  /// Fractions of a huge box may be beyond the largest number.
  static Status check_finite(const ParticleFrame& read, const DumpSection& atoms) {
    const auto beyond = std::find_if(read.positions.begin(), read.positions.end(),
                                     [](const Vec3d& p) { return !is_finite(p); });
    if (beyond == read.positions.end()) return {};
    const auto row = static_cast<std::uint64_t>(beyond - read.positions.begin());
    return error_at_line(atoms.line + row, "its position in the box is too large a number");
  }

  static Status check_scaled(const DumpPositions& positions, const ParticleFrame& read,
                             std::uint64_t line) {
    if (!read.cell) {
      return error_at_line(line, "its positions are fractions of a box, which it does not have",
                           "BOX BOUNDS");
    }
    if (positions.all_scaled() || is_upright(*read.cell)) return {};
    return error_at_line(line,
                         "in a tilted box, all of x, y and z must be fractions of it, or none",
                         positions.names[0]);
  }

  double length_in_angstrom_;
};

Result<std::unique_ptr<ParticleReader>> open_dump(MappedText bytes,
                                                  const ParticleFileOptions& options,
                                                  const ParallelFor&) {
  auto found = find_dump_frames(bytes.text());
  if (!found) return found.error();
  const double length = found.value().length_in_angstrom;
  return std::unique_ptr<ParticleReader>(
      std::make_unique<DumpReader>(std::move(bytes), options, std::move(found).value(), length));
}

bool starts_like_dump(std::string_view start) {
  TextLines lines(start);
  lines.skip_blank_lines();
  return lines.peek().starts_with("ITEM: ");
}

}  // namespace

constinit const ParticleFormat dump_format = {.name = "dump",
                                              .endings = {"dump", "lammpstrj"},
                                              .starts_like = starts_like_dump,
                                              .open = open_dump,
                                              .is_trajectory = true,
                                              .prefix = "dump."};

}  // namespace boule
