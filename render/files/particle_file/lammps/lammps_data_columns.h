#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/lammps/lammps_data_sections.h"

namespace boule {

/// The names of the columns of Atoms, and how they were found.
struct DataColumns {
  std::vector<std::string> names;
  std::string note;  ///< a sentence, if the style had to be guessed
};

/// Those that are `given`; else by the style behind "Atoms #", else by what the first row looks
/// like. Images of the box behind them are skipped. An error for other styles than atomic, charge,
/// bond, angle, molecular, full and sphere.
Result<DataColumns> columns_of_atoms(const DataSections& sections, std::string_view first_row,
                                     const std::vector<std::string>& given);

}  // namespace boule
