#include "render/files/particle_file/lammps/binary_dump.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/files/file/load_number.h"
#include "render/files/particle_file/frame/frame_check.h"
#include "render/files/particle_file/lammps/binary_dump_head.h"
#include "render/files/particle_file/lammps/dump_columns.h"
#include "render/files/particle_file/lammps/dump_places.h"
#include "render/files/particle_file/lammps/id_order.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

Result<DumpPlaces> find_binary_frames(std::string_view bytes) {
  DumpPlaces found;
  std::optional<double> length;
  for (std::size_t at = 0; at < bytes.size() || at == 0;) {
    bool is_cut = false;
    const auto head = read_binary_dump_head(bytes, at, &is_cut);
    const auto end = head ? skip_chunks(bytes, head.value(), nullptr, &is_cut)
                          : Result<std::size_t>(head.error());
    if (is_cut && !found.frames.empty()) {
      found.whole = end.error();
      break;
    }
    if (!end) return end.error();
    if (!length) length = head.value().length_in_angstrom;
    if (auto done = add_frame_place(found.frames, DumpPlace{at}); !done) return done.error();
    at = end.value();
  }
  found.length_in_angstrom = length.value_or(1);
  return found;
}

/// The names that dump atom gives its columns, where a file lacks them: with fractions of the box,
/// as it writes them by itself, and with image flags.
std::vector<std::string> names_of_atom_style(std::size_t columns) {
  if (columns == 5) return {"id", "type", "xs", "ys", "zs"};
  if (columns == 8) return {"id", "type", "xs", "ys", "zs", "ix", "iy", "iz"};
  return {};
}

class BinaryDumpReader : public PlacedReader<DumpPlace> {
 public:
  BinaryDumpReader(MappedText bytes, ParticleFileOptions options, DumpPlaces places)
      : PlacedReader(std::move(bytes), std::move(options), places),
        length_in_angstrom_(places.length_in_angstrom) {}

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor& parallel_for) override {
    auto found = read_binary_dump_head(bytes_.text(), places_.frames[frame].begin);
    if (!found) return found.error();
    const BinaryDumpHead& head = found.value();
    ParticleFrame read;
    read.length_in_angstrom = length_in_angstrom_;
    read.cell = head.cell;
    read.time = head.time;
    const auto names = column_names(head, read);
    if (!names) return names.error();
    DumpColumns columns(names.value(), {}, options_, read);
    if (auto done = columns.check(0); !done) return done.error();
    if (auto done = read_rows(head, columns.columns(), read, parallel_for); !done)
      return done.error();
    if (auto done = check_values(read, options_.lenient); !done) return done.error();
    if (auto done = check_guess(head, read); !done) return done.error();
    if (auto done = columns.finish(0, parallel_for); !done) return done.error();
    return read;
  }

 private:
  [[nodiscard]] bool is_guessed(const BinaryDumpHead& head) const {
    return options_.columns.empty() && head.names.empty();
  }

  [[nodiscard]] Result<std::vector<std::string>> column_names(const BinaryDumpHead& head,
                                                              ParticleFrame& read) const {
    if (!options_.columns.empty()) {
      if (options_.columns.size() == head.columns) return options_.columns;
      return Diagnostic::about("columns", "it has " + std::to_string(head.columns) +
                                              " columns, there are names for " +
                                              std::to_string(options_.columns.size()));
    }
    auto names = head.names.empty() ? names_of_atom_style(head.columns) : head.names;
    if (names.empty()) {
      return Diagnostic::about("columns", "it does not name its " + std::to_string(head.columns) +
                                              " columns; 'columns' can name them");
    }
    if (head.names.empty()) {
      read.notes.push_back("it does not name its columns, taken as " + joined(names, " ") +
                           ", as dump atom writes them; 'columns' names others");
    }
    // There are no texts in it: in place of elements it has types.
    const bool has_types = std::count(names.begin(), names.end(), "type") > 0;
    std::replace(names.begin(), names.end(), std::string("element"),
                 std::string(has_types ? "-" : "type"));
    return names;
  }

  /// Where columns were guessed: all fractions lie in the box, or nearly so.
  [[nodiscard]] Status check_guess(const BinaryDumpHead& head, const ParticleFrame& read) const {
    if (!is_guessed(head)) return {};
    const auto is_fraction = [](double x) { return x > -1 && x < 2; };
    const auto other =
        std::find_if(read.positions.begin(), read.positions.end(), [&](const Vec3d& p) {
          return !(is_fraction(p.x) && is_fraction(p.y) && is_fraction(p.z));
        });
    if (other == read.positions.end()) return {};
    return error_at_row(0, static_cast<std::uint64_t>(other - read.positions.begin()),
                        "it is far from the box by the columns of dump atom, id type xs ys zs; "
                        "'columns' can name those of the file",
                        "columns");
  }

  Status read_rows(const BinaryDumpHead& head, std::span<const TextRowColumn> columns,
                   ParticleFrame& read, const ParallelFor& parallel_for) const;

  double length_in_angstrom_;
};

/// Where a column goes: by particle, `stride` apart.
struct Target {
  std::size_t column;
  double* first;
  std::size_t stride;
};

/// Makes room for the columns.
std::vector<Target> make_room(std::span<const TextRowColumn> columns, std::size_t rows,
                              NumberColumn& species, ParticleFrame& read) {
  std::vector<Target> targets;
  read.positions.resize(rows);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].use == ColumnUse::skipped) continue;
    if (columns[i].use == ColumnUse::position) {
      Vec3d& first = read.positions.front();
      targets.push_back({i, std::array{&first.x, &first.y, &first.z}[columns[i].index], 3});
    } else {
      const bool is_species = columns[i].use == ColumnUse::species;
      auto& values = (is_species ? species : read.numbers[columns[i].index]).values;
      values.resize(rows);
      targets.push_back({i, values.data(), 1});
    }
  }
  return targets;
}

Status BinaryDumpReader::read_rows(const BinaryDumpHead& head,
                                   std::span<const TextRowColumn> columns, ParticleFrame& read,
                                   const ParallelFor& parallel_for) const {
  if (head.atoms == 0) return {};
  const std::string_view bytes = bytes_.text();
  const auto rows = static_cast<std::size_t>(head.atoms);
  const auto skipped = std::count_if(columns.begin(), columns.end(), [](const TextRowColumn& c) {
    return c.use == ColumnUse::skipped;
  });
  if (auto room = check_memory(8 * (columns.size() - static_cast<std::size_t>(skipped)) * rows,
                               std::to_string(rows) + " particles need");
      !room) {
    return room;
  }
  std::vector<BinaryDumpChunk> chunks;
  const auto end = skip_chunks(bytes, head, &chunks);
  if (!end) return end.error();
  NumberColumn species;
  const auto targets = make_room(columns, rows, species, read);
  std::vector<std::size_t> first_rows;
  std::size_t row = 0;
  for (const BinaryDumpChunk& chunk : chunks)
    first_rows.push_back(std::exchange(row, row + chunk.rows));
  const std::size_t row_bytes = 8 * head.columns;
  parallel_for(chunks.size(), [&](std::size_t i) {
    for (const Target& target : targets) {
      const char* from = bytes.data() + chunks[i].at + 8 * target.column;
      double* to = target.first + first_rows[i] * target.stride;
      for (std::size_t k = 0; k < chunks[i].rows; ++k, from += row_bytes, to += target.stride) {
        *to = load_number<double>(from, head.is_big_endian);
      }
    }
    bytes_.let_go(bytes.substr(chunks[i].at, chunks[i].rows * row_bytes));
  });
  if (read.species) {
    species.name = read.species->name;
    read.species = texts_of(species);
  }
  return {};
}

}  // namespace

bool starts_like_binary_dump(std::string_view start) {
  return read_binary_dump_head(start, 0).ok();
}

Result<std::unique_ptr<ParticleReader>> open_binary_dump(MappedText bytes,
                                                         const ParticleFileOptions& options) {
  return placed_reader<BinaryDumpReader>(find_binary_frames(bytes.text()), std::move(bytes),
                                         options);
}

}  // namespace boule
