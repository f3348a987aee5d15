#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/molecule/gemmi_call.h"
#include "render/files/particle_file/molecule/gemmi_particles.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/memory/available_memory.h"

#ifdef BOULE_HAS_GEMMI
#include <gemmi/cif.hpp>
#include <gemmi/elem.hpp>
#include <gemmi/numb.hpp>

#include "render/files/particle_file/molecule/gemmi_bonds.h"
#include "render/files/particle_file/molecule/gemmi_cell.h"
#include "render/files/particle_file/molecule/gemmi_symmetry.h"
#endif

namespace boule {

#ifndef BOULE_HAS_GEMMI

Result<std::vector<ParticleFrame>> read_cif_frames(std::string_view, const ParticleFileOptions&) {
  return Diagnostic::of("no gemmi");
}

#else

namespace {

namespace cif = gemmi::cif;
using Row = cif::Table::Row;

/// With the place, where gemmi tells it: "cif:LINE:COLUMN(BYTE): MESSAGE" or "cif:LINE MESSAGE".
Diagnostic cif_error(const std::string& what) {
  constexpr std::string_view source = "cif:";
  if (what.compare(0, source.size(), source) != 0) return Diagnostic::of(what);
  const char* const end = what.data() + what.size();
  Diagnostic error;
  const char* at = std::from_chars(what.data() + source.size(), end, error.line).ptr;
  if (at < end && *at == ':') {
    at = std::from_chars(at + 1, end, error.column).ptr;
    at = std::find(at, end, ' ');
  }
  while (at < end && (*at == ' ' || *at == ':')) ++at;
  error.message = "gemmi says: " + std::string(at, end);
  return error;
}

/// The symbol at the start of "Fe3+", "C12", "OW"; "X" for others.
const char* element_of(const std::string& symbol) {
  const auto is_letter = [&](std::size_t i) {
    const char c = i < symbol.size() ? symbol[i] : ' ';
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  };
  if (!is_letter(0)) return "X";
  const gemmi::Element one(symbol.substr(0, 1)), two(symbol.substr(0, is_letter(1) ? 2 : 1));
  return (two.elem == gemmi::El::X ? one : two).name();
}

double finite_or(const std::string& text, double other) {
  const double number = text.empty() ? other : cif::as_number(text, other);
  return std::isfinite(number) ? number : other;
}

/// A cell as gemmi has it, and as the frame gets it.
struct CifCell {
  gemmi::UnitCell gemmi;
  ParticleCell particle;
};

/// The atoms of one block of the file.
class CifAtoms {
 public:
  CifAtoms(cif::Block& block, const ParticleFileOptions& options)
      : block_(block), options_(options) {}

  /// The frames; none if the block has no atoms.
  Result<std::vector<ParticleFrame>> read() {
    cif::Table residues = block_.find("_atom_site.", residue_tags());
    if (residues.length() > 0) return read_residues(residues);
    cif::Table sites = block_.find("_atom_site_", site_tags());
    if (sites.length() > 0) return read_sites(sites);
    return std::vector<ParticleFrame>();
  }

 private:
  enum ResidueColumn : std::size_t {
    x,
    y,
    z,
    id,
    symbol,
    atom,
    auth_atom,
    alternative,
    residue,
    auth_residue,
    chain,
    auth_chain,
    residue_number,
    auth_residue_number,
    insertion,
    occupancy,
    b_factor,
    model
  };
  /// In the order of ResidueColumn; '?': may be missing.
  static std::vector<std::string> residue_tags() {
    return {"Cartn_x",       "Cartn_y",         "Cartn_z",
            "?id",           "?type_symbol",    "?label_atom_id",
            "?auth_atom_id", "?label_alt_id",   "?label_comp_id",
            "?auth_comp_id", "?label_asym_id",  "?auth_asym_id",
            "?label_seq_id", "?auth_seq_id",    "?pdbx_PDB_ins_code",
            "?occupancy",    "?B_iso_or_equiv", "?pdbx_PDB_model_num"};
  }
  enum SiteColumn : std::size_t {
    site_x,
    site_y,
    site_z,
    label,
    site_symbol,
    site_occupancy,
    disorder_group
  };
  static std::vector<std::string> site_tags() {
    return {"fract_x",      "fract_y",    "fract_z",        "?label",
            "?type_symbol", "?occupancy", "?disorder_group"};
  }

  Result<std::vector<ParticleFrame>> read_residues(cif::Table& table) {
    const auto cell = cell_of("_cell.");
    if (!cell) return cell.error();
    std::map<std::string, std::size_t> models;  // in `columns`
    const CifBondList listed = options_.most_bonded > 0 ? read_cif_bonds(block_) : CifBondList();
    std::vector<MoleculeColumns> columns;
    std::vector<CifBonds> bonds;
    for (Row row : table) {
      const auto [found, is_new] = models.try_emplace(text_at(row, model), columns.size());
      if (is_new) {
        columns.emplace_back(MoleculeKind::residues, options_.water);
        bonds.emplace_back(listed);
      }
      MoleculeColumns& own = columns[found->second];
      if (auto done = add_atom(table, row, own, bonds[found->second]); !done) return done.error();
    }
    std::vector<ParticleFrame> frames;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].ids().size() <= options_.most_bonded) bonds[i].add_to(columns[i]);
      frames.push_back(columns[i].finish(options_.wanted));
      if (listed.elsewhere > 0 && options_.most_bonded > 0) {
        frames.back().notes.push_back(std::to_string(listed.elsewhere) +
                                      " of its bonds left out: they are to symmetric copies");
      }
      if (cell.value()) frames.back().cell = cell.value()->particle;
      frames.back().axes_matter = false;
    }
    return frames;
  }

  Status add_atom(cif::Table& table, const Row& row, MoleculeColumns& columns, CifBonds& bonds) {
    MoleculeAtom read;
    if (auto done = read_position(table, row, read.position); !done) return done;
    const auto occupied = number_at(table, row, occupancy, "occupancy", 1);
    if (!occupied) return occupied.error();
    const auto factor = number_at(table, row, b_factor, "bfactor", 0);
    if (!factor) return factor.error();
    const std::string name = text_at(row, auth_atom, atom), element = text_at(row, symbol),
                      residue_name = text_at(row, auth_residue, residue),
                      chain_name = text_at(row, auth_chain, chain),
                      location = text_at(row, alternative), code = text_at(row, insertion);
    read.is_guessed = element.empty();
    read.element = read.is_guessed ? element_of_atom(name, residue_name) : element_of(element);
    read.name = name;
    read.residue = residue_name;
    read.chain = chain_name;
    read.insertion = code;
    read.alternative = location;
    // Both may be texts, in theory.
    read.residue_number = finite_or(text_at(row, auth_residue_number, residue_number), 0);
    read.id = finite_or(text_at(row, id), row.row_index + 1);
    read.occupancy = occupied.value();
    read.b_factor = factor.value();
    const auto place = columns.add(read);
    if (!place || bonds.empty()) return {};
    bonds.add_atom(cif_atom_key(chain_name, text_at(row, auth_residue_number, residue_number), code,
                                residue_name, name, location),
                   *place);
    return {};
  }

  Result<std::vector<ParticleFrame>> read_sites(cif::Table& table) {
    const auto cell = cell_of("_cell_");
    if (!cell) return cell.error();
    if (!cell.value()) {
      return error_in(table, "its positions are fractions of a cell, which it does not have");
    }
    auto symmetry = CifSymmetryReader(block_, cell.value()->gemmi).read();
    if (!symmetry) return symmetry.error();
    const std::size_t images = symmetry.value().operations.size();
    if (auto done = check_memory(table.length() * images * MoleculeColumns::atom_bytes,
                                 "the atoms of its cell need");
        !done) {
      return done.error();
    }
    MoleculeColumns columns(MoleculeKind::sites, true);
    std::size_t disordered = 0, sites = 0;
    for (Row row : table) {
      MoleculeAtom read;
      if (auto done = read_position(table, row, read.position); !done) return done.error();
      const auto occupied = number_at(table, row, site_occupancy, "occupancy", 1);
      if (!occupied) return occupied.error();
      if (finite_or(text_at(row, disorder_group), 1) > 1) {
        ++disordered;
        continue;
      }
      const std::string name = text_at(row, label), element = text_at(row, site_symbol);
      read.element = element_of(element.empty() ? name : element);
      read.name = name;
      read.id = row.row_index + 1;
      read.occupancy = occupied.value();
      add_images(read, *cell.value(), symmetry.value().operations, columns);
      ++sites;
    }
    std::vector<ParticleFrame> frames;
    frames.push_back(columns.finish(options_.wanted));
    frames.back().cell = cell.value()->particle;
    note_sites(sites, disordered, symmetry.value(), frames.back());
    return frames;
  }

  /// Adds an atom, whose position is in fractions, wherever the operations put it. An atom without
  /// images stays where the file has it.
  static void add_images(MoleculeAtom atom, const CifCell& cell,
                         const std::vector<gemmi::Op>& operations, MoleculeColumns& columns) {
    const gemmi::Fractional site(atom.position.x, atom.position.y, atom.position.z);
    const auto places =
        operations.size() == 1 ? std::vector{site} : places_in_cell(site, operations, cell.gemmi);
    for (const gemmi::Fractional& place : places) {
      const gemmi::Position p = cell.gemmi.orthogonalize(place);
      atom.position = {p.x, p.y, p.z};
      columns.add(atom);
    }
  }

  static void note_sites(std::size_t sites, std::size_t disordered, const CifSymmetry& symmetry,
                         ParticleFrame& frame) {
    const std::string group = symmetry.group.empty() ? "" : " " + quote(symmetry.group);
    if (!symmetry.is_known) {
      frame.notes.push_back("only the asymmetric unit is read: the space group" + group +
                            " is unknown");
    } else if (symmetry.operations.size() > 1) {
      frame.notes.push_back("the " + std::to_string(frame.size()) +
                            " atoms of the cell are made of " + std::to_string(sites) +
                            " by the symmetry" + group);
    }
    if (disordered == 0) return;
    frame.notes.push_back(std::to_string(disordered) + (disordered == 1 ? " atom" : " atoms") +
                          " left out: other alternative locations");
  }

  [[nodiscard]] bool wants(const char* name) const { return is_wanted(options_.wanted, name); }

  Diagnostic error_in(const cif::Table& table, std::string message, std::string key = {}) const {
    const int line = table.loop_item == nullptr ? 0 : table.loop_item->line_number;
    return {.message = std::move(message), .key = std::move(key), .line = line};
  }

  /// The nearest double to a number that must be there, or, with `none`, to one that may be missing
  /// and is not read unless it is wanted.
  Result<double> number_at(const cif::Table& table, const Row& row, std::size_t column,
                           const char* name, std::optional<double> none) const {
    if (none && (!row.has2(column) || !wants(name))) return *none;
    const double number = cif::as_number(row[column]);
    if (std::isfinite(number) || (none && options_.lenient)) return number;
    return error_in(table,
                    "expected a finite number in row " + std::to_string(row.row_index + 1) +
                        " of the atoms, found " + quote(row[column]),
                    name);
  }

  Status read_position(const cif::Table& table, const Row& row, Vec3d& position) const {
    const std::array<double*, 3> targets{&position.x, &position.y, &position.z};
    constexpr std::array axes{"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto number = number_at(table, row, axis, axes[axis], std::nullopt);
      if (!number) return number.error();
      *targets[axis] = number.value();
    }
    return {};
  }

  /// The cell; nothing where there is none, or one of edges 1, which stands for none.
  Result<std::optional<CifCell>> cell_of(const std::string& prefix) {
    const std::optional<CifCell> none;
    cif::Table table = block_.find(
        prefix, {"length_a", "length_b", "length_c", "angle_alpha", "angle_beta", "angle_gamma"});
    if (table.length() == 0) return none;
    std::array<double, 6> numbers{};
    const Row row = table[0];
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!row.has2(i)) return none;
      numbers[i] = cif::as_number(row[i]);
      if (std::isfinite(numbers[i])) continue;
      return Diagnostic::about("cell", "expected a finite number, found " + quote(row[i]));
    }
    if (std::count(numbers.begin(), numbers.begin() + 3, 1.0) == 3) return none;
    CifCell cell{gemmi::UnitCell(numbers), {}};
    set_fractions(cell.gemmi);
    const auto particle = particle_cell(cell.gemmi);
    if (!particle) return Diagnostic::about("cell", particle.error().message);
    cell.particle = particle.value();
    return std::optional(cell);
  }

  /// What _atom_sites says of the cell's axes, where they lie unusually.
  void set_fractions(gemmi::UnitCell& cell) {
    std::vector<std::string> tags;
    for (const char* row : {"1", "2", "3"}) {
      for (const char* column : {"1", "2", "3"}) {
        tags.push_back(std::string("matrix[") + row + "][" + column + "]");
      }
      tags.push_back(std::string("vector[") + row + "]");
    }
    cif::Table table = block_.find("_atom_sites.fract_transf_", tags);
    if (table.length() == 0) return;
    const Row row = table[0];
    gemmi::Transform fractions;
    std::size_t column_at = 0;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) fractions.mat[i][k] = cif::as_number(row[column_at++]);
      fractions.vec.at(i) = cif::as_number(row[column_at++], 0);
    }
    // Not finite where a number is missing: then it tells nothing.
    if (std::isfinite(fractions.mat.determinant())) cell.set_matrices_from_fract(fractions);
  }

  cif::Block& block_;
  const ParticleFileOptions& options_;
};

}  // namespace

Result<std::vector<ParticleFrame>> read_cif_frames(std::string_view text,
                                                   const ParticleFileOptions& options) {
  std::vector<ParticleFrame> frames;
  auto done = call_gemmi([&]() -> Status {
    cif::Document document = cif::read_memory(text.data(), text.size(), "cif");
    for (cif::Block& block : document.blocks) {
      auto read = CifAtoms(block, options).read();
      if (!read) return read.error();
      frames = std::move(read).value();
      if (!frames.empty()) return {};
    }
    return Diagnostic::of("it holds no positions of atoms: _atom_site.Cartn_x, _atom_site_fract_x");
  });
  if (done) return frames;
  return done.error().line == 0 && done.error().key.empty() ? cif_error(done.error().message)
                                                            : done.error();
}

#endif

}  // namespace boule
