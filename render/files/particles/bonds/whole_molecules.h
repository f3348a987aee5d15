#pragma once

#include <cstddef>
#include <vector>

#include "core/base/error.h"
#include "core/math/vec.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/bonds/bond_finder.h"

namespace boule {

/// Moves particles by whole vectors of the cell, so that each bond leads to where its second
/// particle is: molecules that lie across faces of the cell are whole then. The first particle of
/// each stays where it is; with `into_cell` the middle of each molecule, the mean of its positions,
/// is moved into the cell instead. A molecule that is bonded to its own image, as a chain through
/// the whole cell is, stays as it is. The images of the bonds change with the positions. Returns
/// the number of such endless molecules. The time is linear in the number of particles and bonds,
/// but for a logarithm. An error, about "unwrap", if the cell's vectors lie in a plane, and if
/// there is no memory.
Result<std::size_t> join_molecules(const ParticleCell& cell, bool into_cell,
                                   std::vector<Vec3d>& positions, std::vector<Bond>& bonds);

}  // namespace boule
