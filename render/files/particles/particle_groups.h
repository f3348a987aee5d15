#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/error.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/bonds/bond_finder.h"
#include "render/files/particles/cell_images.h"
#include "render/files/particles/particle_style.h"

namespace boule {

/// The groups of a frame's particles that outlines go around, and of their images.
struct ParticleGroups {
  std::vector<std::uint32_t> of_particles{};  ///< from 1; one for all; empty: there are no groups
  std::uint32_t count = 0;                    ///< of the frame by itself
  bool of_images = false;                     ///< each image has groups of its own

  [[nodiscard]] bool empty() const { return count == 0; }

  /// The group of an image of a particle, 0: none. `counts` is how many images there are; what lies
  /// beyond them has the group of the image beside it.
  [[nodiscard]] std::uint32_t at(std::size_t particle, const ImagePlace& place,
                                 const std::array<int, 3>& counts) const;
};

/// Whether the rule is that of molecules, of a frame that tells them by bonds only.
bool needs_bonds(const OutlineChoice& outline, const ParticleFrame& frame);

/// The groups. `bonds` are those between the particles, if needs_bonds(). An error, about
/// "outline_by", if the frame lacks the column, if its molecules cannot be told, or if there is no
/// memory.
Result<ParticleGroups> make_groups(const ParticleFrame& frame, const OutlineChoice& outline,
                                   const std::vector<Bond>& bonds);

}  // namespace boule
