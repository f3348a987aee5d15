#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/text.h"
#include "core/scene/number_text.h"
#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/lammps/id_order.h"
#include "render/files/particle_file/lammps/lammps_data_columns.h"
#include "render/files/particle_file/lammps/lammps_data_sections.h"
#include "render/files/particle_file/text/named_columns.h"
#include "render/files/particle_file/text/text_interner.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_rows.h"

namespace boule {
namespace {

TextRows rows_of(const DataSection& section, bool lenient) {
  return {.text = section.text,
          .rows = static_cast<std::size_t>(section.rows),
          .first_line = section.line,
          .comments = true,
          .lenient = lenient};
}

class LammpsDataReader : public ParticleReader {
 public:
  LammpsDataReader(MappedText bytes, ParticleFileOptions options, DataSections sections)
      : bytes_(std::move(bytes)), options_(std::move(options)), sections_(std::move(sections)) {}

  [[nodiscard]] std::size_t frames() const override { return 1; }

  Result<ParticleFrame> read(std::size_t, const ParallelFor& parallel_for) override {
    ParticleFrame read;
    read.cell = sections_.cell;
    read.length_in_angstrom = sections_.length_in_angstrom;
    read.notes = sections_.notes;
    if (sections_.atoms == 0) return read;
    NamedColumns columns(options_.wanted, read);
    if (auto done = read_atoms(columns, read, parallel_for); !done) return done.error();
    if (sections_.velocity_rows.exists()) {
      if (auto done = read_velocities(read, parallel_for); !done) return done.error();
    }
    if (auto done = name_elements(read); !done) return done.error();
    if (sections_.bonds > 0 && sections_.atoms <= options_.most_bonded) {
      if (auto done = read_bonds(read, parallel_for); !done) return done.error();
    }
    columns.finish();
    return read;
  }

 private:
  Status read_atoms(NamedColumns& columns, ParticleFrame& read, const ParallelFor& parallel_for) {
    const DataSection& atoms = sections_.atom_rows;
    const std::string_view first_row = TextLines(atoms.text).next();
    const auto found = columns_of_atoms(sections_, first_row, options_.columns);
    if (!found) return found.error();
    const DataColumns& named = found.value();
    if (!named.note.empty()) read.notes.push_back(named.note);
    const auto examples = words_of(first_row);
    for (std::size_t i = 0; i < named.names.size(); ++i) {
      columns.add(named.names[i], examples, i);
    }
    if (auto done = columns.check_positions(); !done) {
      return error_at_line(atoms.line, done.error().message, done.error().key);
    }
    TextRows rows = rows_of(atoms, options_.lenient);
    rows.positive = options_.positive;
    if (auto done = read_text_rows(rows, columns.columns(), read, parallel_for); !done) return done;
    return sort_by_id(read, atoms.line, parallel_for);
  }

  /// Reads the section Velocities and appends its columns to those of the atoms.
  Status read_velocities(ParticleFrame& read, const ParallelFor& parallel_for) {
    const DataSection& section = sections_.velocity_rows;
    ParticleFrame velocities;
    NamedColumns columns(options_.wanted, velocities);
    std::vector<std::string> names{"id", "vx", "vy", "vz"};
    const std::string_view first_row = TextLines(section.text).next();
    constexpr std::size_t with_spin = 7;
    if (words_of(first_row.substr(0, first_row.find('#'))).size() == with_spin) {
      names.insert(names.end(), {"wx", "wy", "wz"});
    }
    for (const std::string& name : names) columns.add(name, "0");
    if (auto done = read_text_rows(rows_of(section, options_.lenient), columns.columns(),
                                   velocities, parallel_for);
        !done) {
      return done;
    }
    if (auto done = sort_by_id(velocities, section.line, parallel_for); !done) return done;
    const NumberColumn* const atom_ids = find_number_column(read, "id");
    if (atom_ids == nullptr || atom_ids->values != velocities.numbers.front().values) {
      return error_at_line(section.line, "its ids are not those of Atoms", "Velocities");
    }
    for (std::size_t i = 1; i < velocities.numbers.size(); ++i) {
      read.numbers.push_back(std::move(velocities.numbers[i]));
    }
    read.unread.insert(read.unread.end(), velocities.unread.begin(), velocities.unread.end());
    return {};
  }

  /// Reads the section Bonds: number, type, and the ids of two atoms.
  Status read_bonds(ParticleFrame& read, const ParallelFor& parallel_for) const {
    const DataSection& section = sections_.bond_rows;
    if (section.rows < sections_.bonds) {
      return error_at_line(section.line,
                           "the header promises " + std::to_string(sections_.bonds) +
                               " rows, there are " + std::to_string(section.rows),
                           "Bonds");
    }
    const NumberColumn* const ids = find_number_column(read, "id");
    if (ids == nullptr) {
      read.notes.emplace_back("its bonds are left out: they are of ids, which no column has");
      return {};
    }
    ParticleFrame rows;
    const std::optional<std::vector<std::string>> all;
    NamedColumns columns(all, rows);
    for (const char* name : {"-", "-", "a", "b"}) columns.add(name, "0");
    if (auto done = read_text_rows(rows_of(section, false), columns.columns(), rows, parallel_for);
        !done) {
      return done;
    }
    read.bonds.resize(section.rows);
    for (const auto end : {&ParticleBond::a, &ParticleBond::b}) {
      const std::vector<double>& atoms = rows.numbers[end == &ParticleBond::a ? 0 : 1].values;
      for (std::size_t i = 0; i < atoms.size(); ++i) {
        const auto found = std::lower_bound(ids->values.begin(), ids->values.end(), atoms[i]);
        if (found == ids->values.end() || *found != atoms[i]) {
          return error_at_line(
              section.line + i,
              "a bond is of atom " + number_text(atoms[i]) + ", which the section Atoms lacks",
              "Bonds");
        }
        read.bonds[i].*end = static_cast<std::uint32_t>(found - ids->values.begin());
      }
    }
    put_in_order(read.bonds);
    read.lists_all_bonds = true;
    return {};
  }

  /// Makes the elements of Masses the species.
  Status name_elements(ParticleFrame& read) const {
    const NumberColumn* const types = find_number_column(read, "type");
    if (sections_.elements.empty() || read.species || types == nullptr) return {};
    TextInterner elements;  // two types may be of one element
    TextColumn species{"element", {}, {}};
    species.indices.reserve(types->values.size());
    const auto count = static_cast<double>(sections_.elements.size());
    for (const double type : types->values) {
      if (type < 1 || type > count || std::trunc(type) != type) {
        return error_at_line(
            sections_.atom_rows.line,
            "an atom is of no type from 1 to " + std::to_string(sections_.elements.size()), "type");
      }
      species.indices.push_back(
          elements.index_of(sections_.elements[static_cast<std::size_t>(type) - 1]));
    }
    species.texts.assign(elements.texts().begin(), elements.texts().end());
    read.species = std::move(species);
    return {};
  }

  MappedText bytes_;
  ParticleFileOptions options_;
  DataSections sections_;
};

Result<std::unique_ptr<ParticleReader>> open_data(MappedText bytes,
                                                  const ParticleFileOptions& options,
                                                  const ParallelFor&) {
  auto sections = find_data_sections(bytes.text());
  if (!sections) return sections.error();
  return std::unique_ptr<ParticleReader>(
      std::make_unique<LammpsDataReader>(std::move(bytes), options, std::move(sections).value()));
}

/// Among the first lines below the title is "N atoms".
bool starts_like_data(std::string_view start) {
  TextLines lines(start);
  lines.next();
  for (int i = 0; i < 20 && !lines.at_end(); ++i) {
    const auto words = words_of(lines.next());
    if (words.size() >= 2 && words[1] == "atoms" &&
        words[0].find_first_not_of("0123456789") == std::string_view::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace

constinit const ParticleFormat lammps_data_format = {.name = "data",
                                                     .endings = {"data", "lmp"},
                                                     .starts_like = starts_like_data,
                                                     .open = open_data,
                                                     .prefix = "data."};

}  // namespace boule
