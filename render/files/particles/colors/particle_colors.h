#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/material_ref.h"
#include "render/files/particle_file/frame/particle_frame.h"
#include "render/files/particles/particle_columns.h"
#include "render/files/particles/particle_spheres.h"
#include "render/files/particles/particle_style.h"
#include "render/files/particles/particle_values.h"

namespace boule {

/// The colours of a frame's particles.
struct ParticleMaterials {
  ParticleValues<MaterialRef> materials;
  ParticleColors colors{};
  std::vector<std::string> notes{};
  ParticleChoices own{};  ///< what the frame by itself has for that: of numbers and kinds
};

/// What is to be coloured, and how. Precondition: style.material < MaterialRef::max_colored, if it
/// is used.
struct ColoredFrame {
  const ParticleFrame& frame;
  const ParticleStyle& style;
  const ParticleNamer& name_of;
  const ParallelFor& parallel_for;

  [[nodiscard]] MaterialRef in(const SrgbColor& color) const {
    return MaterialRef::colored(style.material, color);
  }
};

/// Where colours come from one column of numbers that are kinds, in the series or else in the
/// frame, makes it a column of texts. `own` gets what the frame by itself has for that.
void make_kinds(ParticleFrame& frame, const ParticleStyle& style, ParticleChoices& own);

/// The materials in the colours of a rule. An error, about "color" or "color.by", if there is no
/// such column or it holds something else, and about "material" if that one cannot be coloured.
/// Particles are named as name_of(their place in the frame) does.
Result<ParticleMaterials> make_materials(const ParticleFrame& frame, const ParticleStyle& style,
                                         const ParticleNamer& name_of,
                                         const ParallelFor& parallel_for);

/// A colour map's colours of numbers; errors are about `key`.
Result<ParticleMaterials> map_numbers(const ColoredFrame& colored, const MappedColors& mapped,
                                      const std::string& key);

/// The note of particles that have no number: "3 particles have no number in 'v', ...".
std::string missing_note(const ParticleColors::Scale& scale);

/// The colours whose components are three columns of numbers: all from 0 to 1, or else whole
/// numbers from 0 to 255, which a note tells; of the sRGB curve.
Result<ParticleMaterials> take_components(const ColoredFrame& colored,
                                          const std::vector<std::string>& names);

}  // namespace boule
