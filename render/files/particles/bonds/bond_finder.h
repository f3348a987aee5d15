#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// A bond from a particle to an image of another one, or of itself: the image is so many vectors a,
/// b, c of the cell away from where the frame has the particle.
struct Bond {
  std::uint32_t a = 0, b = 0;
  std::array<std::int32_t, 3> image{};

  friend bool operator==(const Bond&, const Bond&) = default;
};

/// Which particles are bonded: those whose distance is below the sum of their reaches and the
/// tolerance, and above `nearest`.
struct BondSearch {
  ParticleValues<double> reach;  ///< 0: of those that have no bonds; else above 0
  double tolerance = 0;          ///< >= 0
  double nearest = 0;            ///< >= 0
  /// By particle: two of these are not bonded, because their bonds are known, and one that is
  /// single has no more. Empty: none.
  std::vector<std::uint8_t> known{};
  /// By particle: it keeps one bond at most, that to the nearest particle which is none of these;
  /// where there is no such, that to the nearest of these. Empty: none.
  std::vector<std::uint8_t> single{};
};

/// The bonds, each once, in the order of a, b and image; a <= b. Distances are those of the nearest
/// images and of all others, along the periodic directions of the cell, however small it is; a cell
/// whose vectors lie in a plane is left aside. The time is linear in the number of particles and
/// bonds. An error, about "bonds", if there are more bonds than `most`, or too many images.
Result<std::vector<Bond>> find_bonds(const std::vector<Vec3d>& positions,
                                     const std::optional<ParticleCell>& cell,
                                     const BondSearch& search, std::uint64_t most,
                                     const ParallelFor& parallel_for);

/// The bonds of a file, each to the nearest image along the periodic directions of the cell.
std::vector<Bond> nearest_images(const std::vector<ParticleBond>& bonds,
                                 const std::vector<Vec3d>& positions,
                                 const std::optional<ParticleCell>& cell);

}  // namespace boule
