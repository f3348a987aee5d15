#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/lammps/binary_dump.h"
#include "render/files/particle_file/lammps/dump_columns.h"
#include "render/files/particle_file/lammps/dump_frames.h"
#include "render/files/particle_file/lammps/lammps_box.h"
#include "render/files/particle_file/lammps/yaml_dump.h"
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
    auto cell = general ? Result<ParticleCell>(general_cell(rows))
                        : cell_of_dump(box_of(rows, tilted), first_line_);
    if (!cell) return cell;
    if (!is_finite(cell.value())) return too_large_box(first_line_);
    for (std::size_t i = 0; i < 3; ++i) {
      cell.value().periodic[i] = words_.size() < 3 || words_[i].starts_with('p');
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
    const TextRows source{.text = rows,
                          .rows = static_cast<std::size_t>(atoms.rows),
                          .first_line = atoms.line,
                          .lenient = options_.lenient,
                          .positive = options_.positive,
                          .file = &bytes_};
    DumpColumns columns(names.value(), words_of(TextLines(rows).next()), options_, read);
    if (auto done = columns.read(source, atoms.line - 1, parallel_for); !done) return done.error();
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

  double length_in_angstrom_;
};

Result<std::unique_ptr<ParticleReader>> open_text_dump(MappedText bytes,
                                                       const ParticleFileOptions& options) {
  auto found = find_dump_frames(bytes.text());
  if (!found) return found.error();
  const double length = found.value().length_in_angstrom;
  return std::unique_ptr<ParticleReader>(
      std::make_unique<DumpReader>(std::move(bytes), options, std::move(found).value(), length));
}

/// True for bytes that no text has near its start, even where a binary file is damaged.
bool looks_binary(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, 64);
  return std::any_of(start.begin(), start.end(),
                     [](char c) { return c == 0 || static_cast<unsigned char>(c) > 0xF4; });
}

Result<std::unique_ptr<ParticleReader>> open_dump(MappedText bytes,
                                                  const ParticleFileOptions& options,
                                                  const ParallelFor&) {
  if (starts_like_yaml_dump(bytes.text())) return open_yaml_dump(std::move(bytes), options);
  if (looks_binary(bytes.text())) return open_binary_dump(std::move(bytes), options);
  return open_text_dump(std::move(bytes), options);
}

bool starts_like_dump(std::string_view start) {
  TextLines lines(start);
  lines.skip_blank_lines();
  return lines.peek().starts_with("ITEM: ") || starts_like_yaml_dump(start) ||
         starts_like_binary_dump(start);
}

}  // namespace

constinit const ParticleFormat dump_format = {.name = "dump",
                                              .endings = {"dump", "lammpstrj", "bin", "yaml"},
                                              .starts_like = starts_like_dump,
                                              .open = open_dump,
                                              .is_trajectory = true,
                                              .prefix = "dump."};

}  // namespace boule
