#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"

namespace boule {

/// Lines of a GROMACS file, each an atom with fixed columns: residue's number, residue, atom and
/// atom's number of 5 characters each, then positions and velocities.
struct GroRows {
  std::string_view text;         ///< whole lines, as many as rows
  std::size_t rows = 0;          ///< at least 1
  std::uint64_t first_line = 1;  ///< in the file, from 1
  bool lenient = false;          ///< as ParticleFileOptions
};

/// Reads rows into `frame`: positions, the species "element" that names tell (element_guess.h), the
/// texts "resname" and "name", the numbers "resid", "id", and "vx", "vy", "vz" if the first row has
/// velocities (rows that lack them have 0). The first row's decimal points tell how wide positions
/// and velocities are. Of `wanted`, as in ParticleFileOptions, are all columns but the species.
/// Errors have the line, the column, and the name of the column as their key. Refuses what does not
/// fit into memory.
Status read_gro_rows(const GroRows& rows, const std::optional<std::vector<std::string>>& wanted,
                     ParticleFrame& frame, const ParallelFor& parallel_for);

/// The width of a position, by a row's decimal points; nothing for other lines than rows.
std::optional<std::size_t> gro_width(std::string_view row);

}  // namespace boule
