#include "render/files/particle_file/frame/particle_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/math/geometry.h"

namespace boule {
namespace {

template <class Column>
const Column* find_column(const std::vector<Column>& columns, const std::string& name) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const Column& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

}  // namespace

bool is_finite(const ParticleCell& cell) {
  return is_finite(cell.a) && is_finite(cell.b) && is_finite(cell.c) && is_finite(cell.origin);
}

ColumnExtent column_extent(const NumberColumn& column) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  ColumnExtent extent{inf, -inf};
  for (const double value : column.values) {
    if (std::isnan(value)) {
      ++extent.missing;
    } else if (std::isinf(value)) {
      ++extent.infinite;
    } else {
      extent.least = std::min(extent.least, value);
      extent.largest = std::max(extent.largest, value);
    }
  }
  return extent;
}

const NumberColumn* find_number_column(const ParticleFrame& frame, const std::string& name) {
  return find_column(frame.numbers, name);
}

const TextColumn* find_text_column(const ParticleFrame& frame, const std::string& name) {
  return find_column(frame.texts, name);
}

bool is_free_name(const ParticleFrame& frame, const std::string& name) {
  return !name.empty() && name != "x" && name != "y" && name != "z" &&
         find_number_column(frame, name) == nullptr && find_text_column(frame, name) == nullptr;
}

void put_in_order(std::vector<ParticleBond>& bonds) {
  for (ParticleBond& bond : bonds) {
    if (bond.b < bond.a) std::swap(bond.a, bond.b);
  }
  std::erase_if(bonds, [](const ParticleBond& bond) { return bond.a == bond.b; });
  std::sort(bonds.begin(), bonds.end());
  bonds.erase(std::unique(bonds.begin(), bonds.end()), bonds.end());
}

void keep_bonds(std::vector<ParticleBond>& bonds, const std::vector<std::uint8_t>& kept) {
  if (bonds.empty()) return;
  std::vector<std::uint32_t> places(kept.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    places[i] = count;
    count += kept[i];
  }
  std::erase_if(bonds,
                [&](const ParticleBond& bond) { return kept[bond.a] == 0 || kept[bond.b] == 0; });
  for (auto& [a, b] : bonds) {
    a = places[a];
    b = places[b];
  }
}

bool is_wanted(const std::optional<std::vector<std::string>>& wanted, std::string_view name) {
  return !wanted || std::find(wanted->begin(), wanted->end(), name) != wanted->end();
}

void leave_out_unwanted(const std::optional<std::vector<std::string>>& wanted,
                        ParticleFrame& frame) {
  std::erase_if(frame.texts, [&](const TextColumn& column) {
    if (is_wanted(wanted, column.name)) return false;
    frame.unread.push_back(column.name);
    return true;
  });
}

std::string column_unit(std::string_view format, std::string_view column) {
  const bool is_molecule = format == "pdb" || format == "mmcif" || format == "pqr";
  if (!is_molecule && format != "gro") return {};
  const bool is_length = column == "x" || column == "y" || column == "z" || column == "radius";
  if (is_length) return is_molecule ? "\u00c5" : "nm";
  if (is_molecule && column == "bfactor") return "\u00c5\u00b2";
  if (format == "pqr" && column == "charge") return "e";
  const bool is_velocity = column == "vx" || column == "vy" || column == "vz" || column == "|v|";
  return format == "gro" && is_velocity ? "nm/ps" : "";
}

}  // namespace boule
