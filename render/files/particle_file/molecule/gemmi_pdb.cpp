#include "render/files/particle_file/molecule/gemmi_particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "render/files/particle_file/frame/element_guess.h"
#include "render/files/particle_file/molecule/gemmi_call.h"

#ifdef BOULE_HAS_GEMMI
#include <gemmi/pdb.hpp>
#include <gemmi/resinfo.hpp>

#include "render/files/particle_file/molecule/gemmi_cell.h"
#include "render/files/particle_file/text/text_lines.h"
#include "render/files/particle_file/text/text_number.h"
#endif

namespace boule {

#ifndef BOULE_HAS_GEMMI

bool has_gemmi() { return false; }
Status add_pdb_atoms(PdbRecords, MoleculeColumns&) { return Diagnostic::of("no gemmi"); }
void add_pdb_bonds(std::string_view, MoleculeColumns&) {}
Result<ParticleCell> read_pdb_cell(const std::string&) { return Diagnostic::of("no gemmi"); }

#else

namespace {

constexpr std::size_t record_bytes = 81;

/// Replaces the serial numbers by the places of the records, from 0, and returns them.
std::vector<int> take_serials(std::string& records) {
  std::vector<int> serials;
  for (std::size_t at = 0; at < records.size(); at += record_bytes) {
    serials.push_back(gemmi::pdb_impl::read_serial(records.data() + at + 6));
    std::string place = std::to_string(serials.size() - 1);
    place.insert(0, 5 - std::min<std::size_t>(place.size(), 5), ' ');
    records.replace(at + 6, 5, place);
  }
  return serials;
}

struct AtomPlace {
  const gemmi::Residue* residue = nullptr;
  const gemmi::Atom* atom = nullptr;
};

/// The atoms in the order of their records; gemmi puts those of a residue together.
std::vector<AtomPlace> atoms_in_order(const gemmi::Structure& structure, std::size_t count) {
  std::vector<AtomPlace> places(count);
  for (const gemmi::Model& model : structure.models) {
    for (const gemmi::Chain& chain : model.chains) {
      for (const gemmi::Residue& residue : chain.residues) {
        for (const gemmi::Atom& atom : residue.atoms) {
          const auto place = static_cast<std::size_t>(atom.serial);
          if (place < count) places[place] = {&residue, &atom};
        }
      }
    }
  }
  return places;
}

std::string_view record_of(const std::string& records, std::size_t i) {
  return std::string_view(records).substr(i * record_bytes, record_bytes);
}

gemmi::ResidueInfo residue_info(std::string_view name) {
  return gemmi::find_tabulated_residue(std::string(name));
}

/// A residue and its chain, by columns 18 to 22. Column 21 is the fourth letter of a name, or the
/// first of a chain of two behind the name of a residue that is known.
struct RecordNames {
  explicit RecordNames(std::string_view record)
      : residue(without_blanks(record.substr(17, 4))), chain(without_blanks(record.substr(21, 1))) {
    const std::string_view three = without_blanks(record.substr(17, 3));
    if (record[20] == ' ' || chain.empty()) return;
    if (record[17] != ' ' && !residue_info(three).found()) return;
    residue = three;
    chain = record.substr(20, 2);
  }

  std::string_view residue, chain;
};

bool has_element(std::string_view record) {
  return record.substr(76, 2) != "  " && gemmi::find_element(record.data() + 76) != gemmi::El::X;
}

/// True for files whose names of atoms begin in column 13 whatever the element, as programs write
/// them that leave the elements out, too. Elsewhere no single letter stands there.
bool has_unaligned_names(const std::string& records) {
  for (std::size_t i = 0; i * record_bytes < records.size(); ++i) {
    const std::string_view record = record_of(records, i), name = record.substr(12, 4);
    if (name[0] != ' ' && name.substr(1) == "   " && !has_element(record)) return true;
  }
  return false;
}

/// The symbol where the record has none. gemmi goes by the column where the name begins, which
/// nobody needs whose residue tells what the atom can be.
std::string_view guess_element(const gemmi::Atom& atom, const RecordNames& names, bool unaligned) {
  if (const auto ion = ion_of_atom(atom.name, names.residue); !ion.empty()) return ion;
  const gemmi::ResidueInfo residue = residue_info(names.residue);
  // There is no mercury in them: "Hg13" is the hydrogen that others call "HG13".
  if (atom.name.starts_with('H') && (residue.is_amino_acid() || residue.is_nucleic_acid()))
    return "H";
  const bool by_name = unaligned || residue.found() || atom.element == gemmi::El::X;
  return by_name ? element_of_atom(atom.name, names.residue) : atom.element.name();
}

/// Where the atoms are that have a serial number of their own.
class PlacesOfSerials {
 public:
  explicit PlacesOfSerials(const std::vector<double>& serials) {
    for (const double serial : serials) {
      places_.emplace_back(serial, static_cast<std::uint32_t>(places_.size()));
    }
    std::sort(places_.begin(), places_.end());
  }

  [[nodiscard]] std::optional<std::uint32_t> find(double serial) const {
    const auto least = std::lower_bound(places_.begin(), places_.end(), std::pair(serial, 0U));
    if (least == places_.end() || least->first != serial) return std::nullopt;
    if (least + 1 != places_.end() && (least + 1)->first == serial) return std::nullopt;
    return least->second;
  }

 private:
  std::vector<std::pair<double, std::uint32_t> > places_;
};

std::string_view one_letter(const char& letter, char none) {
  return letter == none ? std::string_view() : std::string_view(&letter, 1);
}

}  // namespace

bool has_gemmi() { return true; }

Status add_pdb_atoms(PdbRecords records, MoleculeColumns& columns) {
  return call_gemmi([&]() -> Status {
    const std::vector<int> serials = take_serials(records.lines);
    const gemmi::Structure structure =
        gemmi::read_pdb_from_memory(records.lines.data(), records.lines.size(), "pdb");
    const bool unaligned = has_unaligned_names(records.lines);
    const std::vector<AtomPlace> places = atoms_in_order(structure, serials.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto [residue, atom] = places[i];
      if (residue == nullptr) return Diagnostic::of("gemmi does not understand an atom's record");
      const std::string_view record = record_of(records.lines, i);
      const RecordNames names(record);
      const bool is_guessed = !has_element(record);
      columns.add({.position = records.numbers[i].position,
                   .element = is_guessed ? guess_element(*atom, names, unaligned)
                                         : std::string_view(atom->element.name()),
                   .is_guessed = is_guessed,
                   .name = atom->name,
                   .residue = names.residue,
                   .chain = names.chain,
                   .insertion = one_letter(residue->seqid.icode, ' '),
                   .alternative = one_letter(atom->altloc, '\0'),
                   .residue_number = residue->seqid.num.has_value()
                                         ? static_cast<double>(residue->seqid.num.value)
                                         : 0,
                   .id = static_cast<double>(serials[i]),
                   .occupancy = records.numbers[i].occupancy,
                   .b_factor = records.numbers[i].b_factor});
    }
    return {};
  });
}

void add_pdb_bonds(std::string_view lines, MoleculeColumns& columns) {
  const PlacesOfSerials places(columns.ids());
  for (TextLines rest(lines); !rest.at_end();) {
    const std::string_view line = rest.next();
    if (!is_pdb_bond(line)) continue;
    constexpr std::size_t begin = 6, width = 5, most = 5;
    std::array<std::optional<std::uint32_t>, most> found;
    for (std::size_t i = 0; i < most; ++i) {
      const std::size_t at = begin + i * width;
      std::string serial(line.substr(std::min(at, line.size()), width));
      if (without_blanks(serial).empty()) continue;
      serial.resize(width, ' ');
      found[i] = places.find(gemmi::pdb_impl::read_serial(serial.c_str()));
      if (i > 0 && found[0] && found[i]) columns.add_bond({*found[0], *found[i]});
    }
  }
}

Result<ParticleCell> read_pdb_cell(const std::string& records) {
  ParticleCell cell;
  auto done = call_gemmi([&]() -> Status {
    const auto structure = gemmi::read_pdb_from_memory(records.data(), records.size(), "pdb");
    auto found = particle_cell(structure.cell);
    if (!found) return found.error();
    cell = found.value();
    return {};
  });
  if (!done) return done.error();
  return cell;
}

#endif

}  // namespace boule
