#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <gemmi/cif.hpp>
#include <gemmi/numb.hpp>
#include <gemmi/symmetry.hpp>
#include <gemmi/unitcell.hpp>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace boule {

/// The symmetry operations of a CIF block.
struct CifSymmetry {
  std::vector<gemmi::Op> operations;  ///< the identity is the first; at least that
  std::string group;                  ///< as notes name it
  bool is_known = true;               ///< false: the block names a group that gemmi does not know
};

/// The names of space groups as gemmi has them: "P2(1)/c" of SHELX, "P_m_-3_m", and "R -3 c H",
/// "F d -3 m S", "F d -3 m Z" of ICSD.
inline std::string usual_group_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return c == '(' || c == ')'; }),
             name.end());
  const std::size_t size = name.size();
  if (size < 3 || name[size - 2] != ' ') return name;
  const std::size_t known = std::string("SZHR").find(name.back());
  return known == std::string::npos ? name : name.substr(0, size - 2) + ":" + "12HR"[known];
}

/// The group of a name; in cubic ones, such as "F m 3 m", the minus may be missing, as before 1995.
inline const gemmi::SpaceGroup* group_named(std::string name, const gemmi::UnitCell& cell) {
  name = usual_group_name(std::move(name));
  const auto find = [&] { return gemmi::find_spacegroup_by_name(name, cell.alpha, cell.gamma); };
  const auto* const found = find();
  const std::size_t three = name.rfind('3');
  if (found != nullptr || three == std::string::npos) return found;
  name.insert(three, "-");
  return find();
}

/// "x+0.25" as "x+6/24", which gemmi reads: an operation's parts of a cell are of 24. Nothing where
/// a number is longer than any of these.
inline std::string with_fractions(const std::string& operation) {
  constexpr std::size_t longest = 8;
  std::string text;
  for (std::size_t i = 0; i < operation.size();) {
    const std::size_t end =
        std::min(operation.find_first_not_of("0123456789.", i), operation.size());
    if (end == i) {
      text += operation[i++];
      continue;
    }
    const std::string number = operation.substr(i, end - i);
    if (number.size() > longest) return {};
    const bool is_decimal = number.find('.') != std::string::npos;
    const double parts = is_decimal ? gemmi::cif::as_number(number, 0) * gemmi::Op::DEN : 0;
    text += is_decimal ? std::to_string(std::lround(parts)) + "/24" : number;
    i = end;
  }
  return text;
}

/// What a CIF block says of its symmetry: its list of operations, else its Hall symbol, its
/// Hermann-Mauguin name or its number. A file that says nothing has the identity alone.
class CifSymmetryReader {
 public:
  CifSymmetryReader(gemmi::cif::Block& block, const gemmi::UnitCell& cell)
      : block_(block), cell_(cell) {}

  /// An error names the operation that cannot be read.
  Result<CifSymmetry> read() {
    for (const char* tag : {"_space_group_symop_operation_xyz", "_symmetry_equiv_pos_as_xyz"}) {
      if (const auto column = block_.find_values(tag)) return from_list(column);
    }
    CifSymmetry found;
    if (const gemmi::SpaceGroup* const group = find_group()) {
      found.group = group->xhm();
      found.operations = all_of(group->operations());
    } else {
      found.group = name_;
      found.is_known = name_.empty();
      found.operations = {gemmi::Op::identity()};
    }
    return found;
  }

 private:
  Result<CifSymmetry> from_list(const gemmi::cif::Column& column) {
    constexpr int most = 1024;  // space groups have up to 192
    if (column.length() > most) {
      return Diagnostic::about("symmetry", "it has more than 1024 operations");
    }
    CifSymmetry found;
    find_group();
    found.group = name_;
    for (const std::string& value : column) {
      const std::string text = gemmi::cif::as_string(value);
      gemmi::Op operation = gemmi::Op::identity();
      try {
        operation = gemmi::parse_triplet(with_fractions(text));
      } catch (const std::exception& /*error*/) {
        return Diagnostic::about("symmetry", "the operation " + quote(text) + " cannot be read");
      }
      const bool is_identity = operation == gemmi::Op::identity();
      found.operations.insert(is_identity ? found.operations.begin() : found.operations.end(),
                              operation);
    }
    const bool has_identity =
        !found.operations.empty() && found.operations.front() == gemmi::Op::identity();
    if (!has_identity) found.operations.insert(found.operations.begin(), gemmi::Op::identity());
    return found;
  }

  static std::vector<gemmi::Op> all_of(const gemmi::GroupOps& group) {
    std::vector<gemmi::Op> operations;
    for (const gemmi::Op::Tran& centering : group.cen_ops) {
      for (gemmi::Op operation : group.sym_ops) {
        for (std::size_t i = 0; i < 3; ++i) operation.tran[i] += centering[i];
        operations.push_back(operation);
      }
    }
    return operations;
  }

  /// The text of the first of these tags that has a value.
  std::string text_of(std::initializer_list<const char*> tags) {
    for (const char* tag : tags) {
      const std::string* const value = block_.find_value(tag);
      if (value == nullptr || gemmi::cif::is_null(*value)) continue;
      return gemmi::cif::as_string(*value);
    }
    return {};
  }

  /// The group that the block names, or null. Sets the name for notes.
  const gemmi::SpaceGroup* find_group() {
    const std::string hall = text_of({"_space_group_name_Hall", "_symmetry_space_group_name_Hall"});
    const std::string name = text_of({"_space_group_name_H-M_alt", "_symmetry_space_group_name_H-M",
                                      "_space_group_name_H-M_full", "_space_group.name_H-M_alt"});
    const std::string number = text_of(
        {"_space_group_IT_number", "_symmetry_Int_Tables_number", "_space_group.IT_number"});
    name_ = !name.empty() ? name : !hall.empty() ? hall : number;
    for (const gemmi::SpaceGroup& group : gemmi::spacegroup_tables::main) {
      if (!hall.empty() && hall == group.hall) return &group;
    }
    if (!name.empty()) {
      if (const auto* const found = group_named(name, cell_)) return found;
    }
    if (number.empty()) return nullptr;
    const auto* const found = gemmi::find_spacegroup_by_name(number);
    if (found == nullptr) return nullptr;
    return gemmi::find_spacegroup_by_name(found->hm, cell_.alpha, cell_.gamma);
  }

  gemmi::cif::Block& block_;
  const gemmi::UnitCell& cell_;
  std::string name_;
};

/// The places of an atom in the cell, fractions from 0 to 1, that of the identity first. A place
/// that several operations share, which is closer than 0.4 angstrom as gemmi has it, is there once.
inline std::vector<gemmi::Fractional> places_in_cell(const gemmi::Fractional& site,
                                                     const std::vector<gemmi::Op>& operations,
                                                     const gemmi::UnitCell& cell) {
  constexpr double same_place = 0.4, rounding = 1e-5;  // -1e-6 is 0, not 1
  std::vector<gemmi::Fractional> places;
  for (const gemmi::Op& operation : operations) {
    std::array<double, 3> at = operation.apply_to_xyz({site.x, site.y, site.z});
    for (double& x : at) x -= std::floor(x + rounding);
    const gemmi::Fractional place(at[0], at[1], at[2]);
    const bool is_taken = std::any_of(places.begin(), places.end(), [&](const auto& other) {
      return cell.distance_sq(place, other) < same_place * same_place;
    });
    if (!is_taken) places.push_back(place);
  }
  return places;
}

}  // namespace boule
