#pragma once

#include <array>
#include <cstdint>
#include <gemmi/cif.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/files/particle_file/molecule/molecule_columns.h"

// Bonds of mmCIF files, for what is compiled with gemmi.

namespace boule {

/// The text of a value; empty for '?', '.' and columns that are not there.
inline std::string text_at(const gemmi::cif::Table::Row& row, std::size_t column) {
  return row.has2(column) ? gemmi::cif::as_string(row[column]) : std::string();
}

/// The first of two columns that has a value.
inline std::string text_at(const gemmi::cif::Table::Row& row, std::size_t column,
                           std::size_t other) {
  std::string text = text_at(row, column);
  return text.empty() ? text_at(row, other) : text;
}

/// What tells atoms apart in a model: chain, number and insertion code of the residue, its name,
/// name and location of the atom.
inline std::string cif_atom_key(const std::string& chain, const std::string& number,
                                const std::string& insertion, const std::string& residue,
                                const std::string& name, const std::string& location) {
  std::string key;
  for (const std::string* const part : {&chain, &number, &insertion, &residue, &name, &location}) {
    key += *part + '\n';
  }
  return key;
}

/// The bonds that a file lists, of all its models.
struct CifBondList {
  std::vector<std::array<std::string, 2>> keys;  ///< of the atoms
  std::size_t elsewhere = 0;                     ///< bonds to symmetric copies, which are left out
};

/// Reads _struct_conn: covalent bonds and those of metals.
inline CifBondList read_cif_bonds(gemmi::cif::Block& block) {
  CifBondList list;
  std::vector<std::string> tags{"conn_type_id"};
  constexpr std::size_t of_partner = 11;
  for (const std::string n : {"1", "2"}) {
    const std::string end = "?ptnr" + n + "_", pdbx = "?pdbx_ptnr" + n + "_";
    for (const char* const tag : {"auth_asym_id", "label_asym_id", "auth_seq_id", "label_seq_id"}) {
      tags.push_back(end + tag);
    }
    tags.push_back(pdbx + "PDB_ins_code");
    for (const char* const tag :
         {"auth_comp_id", "label_comp_id", "auth_atom_id", "label_atom_id"}) {
      tags.push_back(end + tag);
    }
    tags.push_back(pdbx + "label_alt_id");
    tags.push_back(end + "symmetry");
  }
  gemmi::cif::Table table = block.find("_struct_conn.", tags);
  for (const auto row : table) {
    const std::string type = gemmi::to_lower(text_at(row, 0));
    if (type.rfind("covale", 0) != 0 && type != "disulf" && type != "metalc") continue;
    std::array<std::string, 2> keys, symmetry;
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t at = 1 + i * of_partner;
      keys[i] = cif_atom_key(text_at(row, at, at + 1), text_at(row, at + 2, at + 3),
                             text_at(row, at + 4), text_at(row, at + 5, at + 6),
                             text_at(row, at + 7, at + 8), text_at(row, at + 9));
      symmetry[i] = text_at(row, at + 10);
      if (symmetry[i].empty()) symmetry[i] = "1_555";
    }
    if (symmetry[0] == symmetry[1]) {
      list.keys.push_back(std::move(keys));
    } else {
      ++list.elsewhere;
    }
  }
  return list;
}

/// The bonds of one model, whose atoms are met one by one.
class CifBonds {
 public:
  explicit CifBonds(const CifBondList& list) : list_(list) {
    for (const auto& [a, b] : list.keys) places_[a], places_[b];
  }

  [[nodiscard]] bool empty() const { return places_.empty(); }

  void add_atom(const std::string& key, std::uint32_t place) {
    const auto found = places_.find(key);
    if (found != places_.end() && !found->second) found->second = place;
  }

  void add_to(MoleculeColumns& columns) const {
    for (const auto& [a, b] : list_.keys) {
      const auto first = places_.at(a), second = places_.at(b);
      if (first && second) columns.add_bond({*first, *second});
    }
  }

 private:
  const CifBondList& list_;
  std::map<std::string, std::optional<std::uint32_t>> places_;
};

}  // namespace boule
