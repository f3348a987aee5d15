#pragma once

#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/apps/job/particle_look.h"
#include "render/files/particle_file/particle_file.h"
#include "render/files/scene_file/scene_file.h"

namespace boule {

/// Whether a file is shown by a scene that is made for it: one of particles by the options, its
/// name or its content. A .npy file is one if it has named fields, or if an
/// option of particles was given.
bool is_particle_input(const std::string& path, const LookOptions& look);

/// How the file is read, with all its columns.
ParticleFileOptions file_options_of(const LookOptions& look);

/// An error about an input that is no particle file, although `option` needs one.
Diagnostic not_particles(const std::string& path, const std::string& option);

/// The scene of a file that is none of particles; not_particles() if an option of these was given.
/// The error for a name that is neither a scene's nor that of particles tells the endings of both.
Result<LoadedScene> load_known(const std::string& path, const LookOptions& look,
                               const SceneFileOptions& options);

/// The scene of a particle file.
struct ParticleScene {
  std::string text;  ///< TOML: a file of it, in the working directory, has the same picture
  LoadedScene loaded;
  std::optional<LookFloor> floor;  ///< if it has one
};

/// Makes the scene that shows a particle file and reads it. If there is to be a floor, it is
/// `floor`, else the one below what this frame shows. A Diagnostic whose key is an option
/// ("--color") is about what the command line says of particles, any other about the file.
Result<ParticleScene> load_particle_scene(const std::string& path, const LookOptions& look,
                                          const SceneFileOptions& options,
                                          const std::optional<LookFloor>& floor = {});

/// How far along a direction, which has unit length, the spheres begin, counted from the scene's
/// origin; none if there are no spheres.
std::optional<double> lowest_along(const Vec3d& direction, const LoadedScene& loaded);

/// The floor at lowest_along(up), which touches what is lowest, in a scene with this origin.
LookFloor floor_at(double lowest, const Vec3d& up, const Vec3d& origin);

/// Puts the floor into a scene that has the text of one without it.
void add_floor(const LookFloor& floor, LoadedScene& loaded);

/// A frame of a particle file with all of its columns, of which a picture needs few: what is no
/// finite number in one that the picture did not need is kept (ParticleFileOptions::lenient).
Result<ParticleFrame> read_all_columns(const LookOptions& look, const ParticleFacts& facts,
                                       const ParallelFor& parallel_for);

}  // namespace boule
