#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/bonds/bond_finder.h"
#include "render/files/particles/particle_choices.h"
#include "render/files/particles/particle_radii.h"
#include "render/files/particles/particle_style.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// What is drawn of a frame, and by which rule its bonds are found.
struct BondPlan {
  ParticleShape shape = ParticleShape::space_filling;
  BondChoice bonds = BondRule::none;    ///< never nothing
  bool has_listed = false;              ///< the file lists bonds of particles that may be hidden
  bool unwraps = false, wraps = false;  ///< as ParticleStyle
};

/// ParticleFileOptions::most_bonded for a style.
std::uint64_t most_bonded_of(const ParticleStyle& style);

/// Decides the style's open choices for a frame that is read, with all of its particles; `own` gets
/// what the frame by itself has for them, `style.chosen` has what a series chooses. An error, about
/// "radius" or "radii", if sticks are to have radii of their own.
Result<BondPlan> plan_bonds(const ParticleFrame& frame, const ParticleStyle& style,
                            ParticleChoices& own);

/// The radius of bonds, before it is scaled as those of sticks are. `smallest_radius` is that of
/// the spheres that fill space; `own` gets it where radii of bonds come from it, those of a series
/// come from the smallest of all frames.
double choose_bond_radius(const ParticleFrame& frame, const ParticleStyle& style,
                          const BondPlan& plan, double smallest_radius, ParticleChoices& own);

/// Where the radii of balls, or of sticks, come from: from those of spheres that fill space.
RadiusSource shaped_radii(RadiusSource source, const ParticleFrame& frame,
                          const ParticleStyle& style, const BondPlan& plan, double bond_radius);

/// The bonds of a frame's particles. Positions are where they are drawn, `radii` those of spheres
/// that fill space. An error, about "bonds", where the rule needs what the file lacks, and if there
/// are too many: each bond makes so many capsules.
Result<std::vector<Bond>> make_bonds(ParticleFrame& frame, const BondPlan& plan,
                                     const ParticleValues<float>& radii, std::uint64_t images,
                                     const ParallelFor& parallel_for);

}  // namespace boule
