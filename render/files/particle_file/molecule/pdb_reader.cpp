#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "render/files/particle_file/frame/particle_format.h"
#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "render/files/particle_file/molecule/molecule_columns.h"
#include "render/files/particle_file/molecule/pdb_records.h"
#include "render/files/particle_file/text/text_lines.h"

namespace boule {
namespace {

class PdbReader : public PlacedReader<PdbFrame> {
 public:
  using PlacedReader::PlacedReader;

  Result<ParticleFrame> read(std::size_t frame, const ParallelFor&) override {
    const PdbFrame& place = places_.frames[frame];
    MoleculeColumns columns(MoleculeKind::residues, options_.water);
    if (auto done = columns.reserve(place.atoms); !done) return done.error();
    auto cell = cell_of(place);
    if (!cell) return cell.error();
    if (auto done = read_atoms(place, columns); !done) return done.error();
    if (place.atoms <= options_.most_bonded) add_bonds(place, columns);
    ParticleFrame read = columns.finish(options_.wanted);
    read.cell = cell.value();
    read.axes_matter = false;
    return read;
  }

 private:
  [[nodiscard]] bool wants(const char* name) const { return is_wanted(options_.wanted, name); }

  [[nodiscard]] Result<std::optional<ParticleCell>> cell_of(const PdbFrame& place) const {
    if (place.cell_line == 0) return std::optional<ParticleCell>();
    const auto records = pdb_cell_records(bytes_.text().substr(place.cell), place.cell_line);
    if (!records) return records.error();
    if (records.value().empty()) return std::optional<ParticleCell>();
    auto cell = read_pdb_cell(records.value());
    if (!cell) return error_at_line(place.cell_line, cell.error().message, "CRYST1");
    return std::optional(cell.value());
  }

  /// The bonds of the frame, or those at the end of the file, which are of all frames.
  void add_bonds(const PdbFrame& place, MoleculeColumns& columns) const {
    const std::string_view own = bytes_.text().substr(place.begin, place.end - place.begin);
    TextLines lines(own);
    bool has_own = false;
    while (!lines.at_end() && !has_own) has_own = is_pdb_bond(lines.next());
    add_pdb_bonds(has_own ? own : bytes_.text().substr(places_.frames.back().end), columns);
  }

  /// Gives gemmi so many records at once that its own structures stay small.
  Status read_atoms(const PdbFrame& place, MoleculeColumns& columns) const {
    constexpr std::size_t most_at_once = 10000;
    const PdbFields fields{
        .occupancy = wants("occupancy"), .b_factor = wants("bfactor"), .lenient = options_.lenient};
    TextLines lines(bytes_.text().substr(place.begin, place.end - place.begin));
    PdbRecords records;
    const auto flush = [&] { return add_pdb_atoms(std::exchange(records, {}), columns); };
    while (!lines.at_end()) {
      const std::uint64_t number = place.line + lines.line() - 1;
      const std::string_view line = lines.next();
      if (!is_pdb_atom(line)) continue;
      if (auto done = add_pdb_record(line, number, fields, records); !done) return done;
      if (records.numbers.size() < most_at_once) continue;
      if (auto done = flush(); !done) return done;
    }
    return !records.numbers.empty() ? flush() : Status();
  }
};

Result<std::unique_ptr<ParticleReader>> open_pdb(MappedText bytes,
                                                 const ParticleFileOptions& options,
                                                 const ParallelFor&) {
  if (!has_gemmi()) return Diagnostic::of("this build of Boule lacks gemmi's reader of PDB files");
  return placed_reader<PdbReader>(find_pdb_frames(bytes.text(), !bytes.whole().ok()),
                                  std::move(bytes), options);
}

/// The first atom's record has positions.
bool starts_like_pdb(std::string_view start) {
  for (TextLines lines(start); !lines.at_end();) {
    const std::string_view line = lines.next();
    PdbRecords record;
    if (!is_pdb_atom(line)) continue;
    return add_pdb_record(line, 1, {.occupancy = false, .b_factor = false}, record).ok();
  }
  return false;
}

}  // namespace

constinit const ParticleFormat pdb_format = {.name = "pdb",
                                             .endings = {"pdb", "ent"},
                                             .starts_like = starts_like_pdb,
                                             .open = open_pdb,
                                             .is_trajectory = true,
                                             .names_columns = true};

}  // namespace boule
