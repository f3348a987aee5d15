#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/files/particles/particle_spheres.h"
#include "render/files/scene_file/loaded/loaded_scene.h"
#include "render/files/scene_file/loaded/particle_facts.h"
#include "render/files/scene_file/toml/particle_source.h"
#include "render/files/scene_file/toml/toml_table.h"

namespace boule {

/// What a table [[particles]] is read as: its spheres, not yet rounded, and what is told of them.
struct TomlParticles {
  /// Of the two there is one.
  std::optional<ParticleSpheres> spheres;
  std::shared_ptr<ParticleSource> source;
  ParticleFacts facts;
  std::vector<std::string> notes;  ///< each "FILE: SENTENCE"
};

/// The indices of the material that a table names, and of that of its ghosts.
struct ParticleMaterialIds {
  std::uint32_t own, ghosts;
};

/// Reads a table [[particles]] and the frame of its file.
/// Errors are reported through the table, those in the file's text at their place there; then there
/// is no value. `may_stream`: the spheres may stay in the file, which is then their source.
std::optional<TomlParticles> read_particles(TomlTable& table, const ParticleMaterialIds& materials,
                                            const SceneFileOptions& options, bool may_stream);

}  // namespace boule
