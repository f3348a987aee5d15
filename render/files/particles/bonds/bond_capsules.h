#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/scene/outline_groups.h"
#include "core/scene/primitive.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/bonds/bond_finder.h"
#include "render/files/particles/boundary_images.h"
#include "render/files/particles/cell_images.h"
#include "render/files/particles/particle_groups.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// What bonds are drawn from. It is a view.
struct BondedParticles {
  const std::vector<Vec3d>& positions;
  const ParticleValues<float>& radii;
  const ParticleValues<MaterialRef>& materials;
  const std::optional<ParticleCell>& cell;
  const CellImages& images;
  Vec3d origin{};                            ///< is subtracted in double, as from spheres
  const BoundaryImages* boundary = nullptr;  ///< null: nothing is repeated on faces
  const ParticleGroups* groups = nullptr;    ///< that outlines go around; null: none
  OutlineGroups* group_list = nullptr;       ///< gets the groups of the capsules; null: none
};

/// How bonds look.
struct BondLook {
  float radius = 0;
  std::optional<MaterialRef> material{};  ///< of all; none: half bonds have their particles'
};

/// Appends the capsules of bonds, of one image after the other: each bond is two halves, which meet
/// in the middle of what is seen between both spheres, or one capsule if both halves are of one
/// material and group. Their ends are the centres of the spheres, to the bit. A bond that leaves
/// all images of the cell is two pieces, one at each end, which end at the cell's faces; but it is
/// whole where both ends are shown.
void append_bonds(const BondedParticles& particles, const std::vector<Bond>& bonds,
                  const BondLook& look, std::vector<Capsule>& capsules);

/// Appends the bonds that begin at what is repeated on faces and end at what is shown.
void append_boundary_bonds(const BondedParticles& particles, const std::vector<Bond>& bonds,
                           const BondLook& look, std::vector<Capsule>& capsules);

/// Appends the edges of the box that all images of the cell fill. Edges of length 0 are left out.
void append_cell_edges(const BondedParticles& particles, const BondLook& look,
                       std::vector<Capsule>& capsules);

/// The radius of such edges, by the size of the cell.
float cell_edge_radius(const ParticleCell& cell);

}  // namespace boule
