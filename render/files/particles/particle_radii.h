#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/particle_style.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// Where radii come from: a rule that has been decided for a frame.
struct RadiusSource {
  std::string column;              ///< its numbers times `factor`; empty: one of the next
  std::vector<double> by_species;  ///< by the species' number
  double all = 0;                  ///< where both of these are empty
  double factor = 1;
  std::string text;  ///< ParticleSpheres::radius_source()
  std::vector<std::string> notes;
};

/// Decides the rule of a style for particles that are drawn as `shape`, and the radii that it gives
/// for species. The typical distance is that of all particles of the frame, or what `style.chosen`
/// has if it is not null; `own` gets what the frame by itself has for that. An error, about
/// "radius" or "radii", if there is no such column or species or, for tables, no species at all.
Result<RadiusSource> find_radius_source(const ParticleFrame& frame, const ParticleStyle& style,
                                        ParticleShape shape, ParticleChoices& own,
                                        const ParallelFor& parallel_for);

/// The radii of a frame's particles.
struct ParticleRadii {
  ParticleValues<float> radii;
  double smallest = 0;  ///< before it is rounded; 0 where there are no particles
};

/// The radii from the source times `scale`. Each must be finite and above 0, as a float too: else
/// an error about "radius", or "scale" where only the product is wrong, that names the particle as
/// name_of(its place in the frame) does.
Result<ParticleRadii> make_radii(const ParticleFrame& frame, const RadiusSource& source,
                                 double scale, const ParticleNamer& name_of,
                                 const ParallelFor& parallel_for);

}  // namespace boule
