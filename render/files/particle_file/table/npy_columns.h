#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/files/file/npy_header.h"
#include "render/files/particle_file/table/binary_table.h"

namespace boule {

/// The columns and rows that the header of a .npy file declares. A field of three values has three
/// columns: x, y, z of "pos", "position" or "positions"; vx, vy, vz of "vel", "velocity" or
/// "velocities"; NAME_x, NAME_y, NAME_z of others. One of n values has NAME_1 to NAME_n. Rows of
/// numbers without names have x, y, z, radius, c5 and so on, or `names` if there are any. Errors
/// have a message only, and the name of a field as their key: types that are no numbers or texts,
/// more than 2^31 bytes a row.
Result<BinaryTable> npy_table(const NpyHeader& header, const std::vector<std::string>& names);

}  // namespace boule
