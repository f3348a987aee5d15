#include "render/files/particle_file/molecule/molecule_columns.h"

#include <algorithm>
#include <array>
#include <utility>

#include "render/files/particle_file/frame/element_guess.h"
#include "render/memory/available_memory.h"

namespace boule {
namespace {

bool is_water(std::string_view residue) {
  constexpr std::array<std::string_view, 4> names{"HOH", "WAT", "DOD", "H2O"};
  return std::count(names.begin(), names.end(), residue) > 0;
}

std::string count_of(std::size_t atoms) {
  return std::to_string(atoms) + (atoms == 1 ? " atom" : " atoms");
}

/// Keeps the values whose row is not in `out`.
template <class T>
void leave_out(const std::vector<bool>& out, std::vector<T>& values) {
  std::size_t kept = 0;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!out[row]) values[kept++] = values[row];
  }
  values.resize(kept);
}

/// Drops the texts that no row has.
void renumber(TextColumn& column) {
  constexpr std::uint32_t none = UINT32_MAX;
  std::vector<std::uint32_t> numbers(column.texts.size(), none);
  std::vector<std::string> used;
  for (std::uint32_t& index : column.indices) {
    if (numbers[index] == none) {
      numbers[index] = static_cast<std::uint32_t>(used.size());
      used.push_back(std::move(column.texts[index]));
    }
    index = numbers[index];
  }
  column.texts = std::move(used);
}

}  // namespace

std::uint32_t MoleculeColumns::Texts::add(std::string_view text) {
  std::vector<std::uint32_t>& indices = column.indices;
  if (!indices.empty() && column.texts[indices.back()] == text) {
    indices.push_back(indices.back());
    return indices.back();
  }
  auto found = known.find(text);
  if (found == known.end()) {
    found = known.try_emplace(std::string(text), static_cast<std::uint32_t>(known.size())).first;
    column.texts.emplace_back(text);
  }
  indices.push_back(found->second);
  return found->second;
}

MoleculeColumns::MoleculeColumns(MoleculeKind kind, bool water) : kind_(kind), keeps_water_(water) {
  if (kind != MoleculeKind::charges) return;
  occupancies_.name = "charge";
  b_factors_.name = "radius";
}

Status MoleculeColumns::check_room(std::uint64_t atoms) {
  return check_memory(atoms * atom_bytes, std::to_string(atoms) + " atoms need");
}

Status MoleculeColumns::reserve(std::uint64_t number) {
  if (auto done = check_room(number); !done) return done;
  const auto atoms = static_cast<std::size_t>(number);
  positions_.reserve(atoms);
  for (NumberColumn* column : {&ids_, &residue_numbers_, &occupancies_, &b_factors_}) {
    column->values.reserve(atoms);
  }
  for (Texts* texts : {&elements_, &names_, &residues_, &chains_}) {
    texts->column.indices.reserve(atoms);
  }
  is_water_.reserve(atoms);
  return {};
}

bool MoleculeColumns::is_alternative(const MoleculeAtom& atom) {
  std::string place(atom.chain);
  place += '\n' + std::to_string(atom.residue_number) + '\n';
  place += atom.insertion;
  if (place_number_ == 0 || place != place_) {
    place_ = std::move(place);
    place_residue_ = atom.residue;
    ++place_number_;
  }
  if (!atom.alternative.empty() && atom.residue != place_residue_) return true;
  const auto name = names_.known.find(atom.name);
  const bool seen = name != names_.known.end() && name->second < seen_at_.size() &&
                    seen_at_[name->second] == place_number_;
  return !atom.alternative.empty() && seen;
}

std::optional<std::uint32_t> MoleculeColumns::add(const MoleculeAtom& atom) {
  if (is_alternative(atom)) {
    ++alternatives_;
    return std::nullopt;
  }
  positions_.push_back(atom.position);
  elements_.add(atom.element);
  const std::uint32_t name = names_.add(atom.name);
  if (seen_at_.size() <= name) seen_at_.resize(name + 1);
  seen_at_[name] = place_number_;
  residues_.add(atom.residue);
  chains_.add(atom.chain);
  ids_.values.push_back(atom.id);
  residue_numbers_.values.push_back(atom.residue_number);
  occupancies_.values.push_back(atom.occupancy);
  b_factors_.values.push_back(atom.b_factor);
  is_water_.push_back(is_water(atom.residue));
  if (is_water_.back()) ++water_;
  if (atom.is_guessed) ++guessed_;
  return static_cast<std::uint32_t>(positions_.size() - 1);
}

void MoleculeColumns::leave_out_water(ParticleFrame& frame) const {
  leave_out(is_water_, frame.positions);
  leave_out(is_water_, frame.species->indices);
  renumber(*frame.species);
  for (NumberColumn& column : frame.numbers) leave_out(is_water_, column.values);
  for (TextColumn& column : frame.texts) {
    leave_out(is_water_, column.indices);
    renumber(column);
  }
  std::vector<std::uint8_t> kept(is_water_.size());
  for (std::size_t row = 0; row < kept.size(); ++row) kept[row] = is_water_[row] ? 0 : 1;
  keep_bonds(frame.bonds, kept);
  frame.notes.push_back(count_of(water_) + " of water left out");
}

ParticleFrame MoleculeColumns::finish(const std::optional<std::vector<std::string>>& wanted) {
  ParticleFrame frame;
  frame.positions = std::move(positions_);
  frame.species = std::move(elements_.column);
  frame.bonds = std::move(bonds_);
  put_in_order(frame.bonds);
  const auto keep = [&](auto& columns, auto& column, MoleculeKind kind) {
    if (kind_ == MoleculeKind::sites && kind != kind_) return;
    if (is_wanted(wanted, column.name)) {
      columns.push_back(std::move(column));
    } else {
      frame.unread.push_back(column.name);
    }
  };
  keep(frame.numbers, ids_, MoleculeKind::sites);
  keep(frame.numbers, residue_numbers_, MoleculeKind::residues);
  keep(frame.numbers, occupancies_, MoleculeKind::sites);
  keep(frame.numbers, b_factors_, MoleculeKind::residues);
  keep(frame.texts, names_.column, MoleculeKind::sites);
  keep(frame.texts, residues_.column, MoleculeKind::residues);
  keep(frame.texts, chains_.column, MoleculeKind::residues);
  if (!keeps_water_ && water_ > 0 && water_ < frame.size()) leave_out_water(frame);
  if (guessed_ > 0) frame.notes.emplace_back(elements_are_guessed);
  if (alternatives_ > 0) {
    frame.notes.push_back(count_of(alternatives_) + " left out: other alternative locations");
  }
  return frame;
}

}  // namespace boule
