#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// A section of a LAMMPS data file: the rows below its name.
struct DataSection {
  std::string style;       ///< what the comment behind the name says: "full"
  std::string_view text;   ///< of its rows
  std::uint64_t line = 0;  ///< of the first row; 0: the file has no such section
  std::uint64_t rows = 0;
  [[nodiscard]] bool exists() const { return line != 0; }
};

/// What a LAMMPS data file says besides its rows of atoms.
struct DataSections {
  std::uint64_t atoms = 0, types = 0, bonds = 0;  ///< counts of the header
  std::optional<ParticleCell> cell;
  /// By type, from 1 on at index 0: the element that stands behind the mass in a comment ("# C").
  /// Empty unless all types have one.
  std::vector<std::string> elements;
  DataSection atom_rows, velocity_rows;
  DataSection bond_rows;  ///< as many rows as there are, at most those of the header

  double length_in_angstrom = 1;   ///< by "units = real" of the first line
  std::vector<std::string> notes;  ///< sentences: what is taken for lines that are not there
};

/// Finds the sections of a LAMMPS data file (docs.lammps.org/read_data.html) and reads its header.
Result<DataSections> find_data_sections(std::string_view text);

}  // namespace boule
