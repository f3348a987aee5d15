#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// An atom of a molecule. The texts are views of memory that must last as long as the call.
struct MoleculeAtom {
  Vec3d position;
  std::string_view element;
  bool is_guessed = false;  ///< the file does not tell the element
  std::string_view name;
  std::string_view residue, chain;  ///< names
  std::string_view insertion;       ///< residue's insertion code; empty: none
  std::string_view alternative;     ///< location; empty: the only one
  double residue_number = 0, id = 0, occupancy = 1, b_factor = 0;
};

/// What the columns of a frame are.
enum class MoleculeKind {
  residues,  ///< of proteins: "id", "resid", "occupancy", "bfactor"; "name", "resname", "chain"
  sites,     ///< of small molecules: "id", "occupancy"; "name"
  charges,   ///< as residues, with "charge" and "radius" in place of occupancy and B factor
};

/// A frame of molecules that grows atom by atom. Only the first of alternative locations is kept:
/// of an atom, and of residues that have one place in the chain.
class MoleculeColumns {
 public:
  MoleculeColumns(MoleculeKind kind, bool water);

  /// An error if so many atoms do not fit into memory.
  static Status check_room(std::uint64_t atoms);
  /// Makes room for them.
  Status reserve(std::uint64_t atoms);
  /// The place of the atom in the frame before water is left out; none for other locations.
  std::optional<std::uint32_t> add(const MoleculeAtom& atom);
  void add_bond(const ParticleBond& bond) { bonds_.push_back(bond); }
  /// The ids of the atoms that were kept.
  [[nodiscard]] const std::vector<double>& ids() const { return ids_.values; }

  /// The frame with the `wanted` columns, as in ParticleFileOptions. Water (HOH, WAT, DOD, H2O) is
  /// left out if that was asked for and there is something else. Notes say what is left out.
  ParticleFrame finish(const std::optional<std::vector<std::string>>& wanted);

  /// Bytes of memory that an atom takes.
  static constexpr std::size_t atom_bytes = sizeof(Vec3d) + 4 * sizeof(double) + 16 + 1;

 private:
  /// Texts that are numbered in the order of their first use.
  struct Texts {
    TextColumn column;
    std::map<std::string, std::uint32_t, std::less<>> known{};
    std::uint32_t add(std::string_view text);
  };

  bool is_alternative(const MoleculeAtom& atom);
  void leave_out_water(ParticleFrame& frame) const;

  MoleculeKind kind_;
  bool keeps_water_;
  std::vector<Vec3d> positions_;
  NumberColumn ids_{"id", {}}, residue_numbers_{"resid", {}}, occupancies_{"occupancy", {}},
      b_factors_{"bfactor", {}};
  Texts elements_{{"element", {}, {}}}, names_{{"name", {}, {}}}, residues_{{"resname", {}, {}}},
      chains_{{"chain", {}, {}}};
  std::vector<ParticleBond> bonds_;
  std::vector<bool> is_water_;
  std::size_t water_ = 0, alternatives_ = 0, guessed_ = 0;

  // The residue that the last atom belongs to.
  std::string place_;                   // chain, number, insertion code
  std::string place_residue_;           // name of the first residue there
  std::uint32_t place_number_ = 0;      // counts places
  std::vector<std::uint32_t> seen_at_;  // by name of atom: the last place that has it
};

}  // namespace boule
