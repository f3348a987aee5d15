#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/math/vec.h"
#include "core/scene/scene.h"
#include "render/scene_file/particle_facts.h"

namespace boule {

class ParticleFileCache;
struct SceneData;

/// What an NFF polygon becomes: its infinite plane, nothing, or an error.
enum class PolygonPolicy { plane, skip, error };

/// How a scene file is read.
struct SceneFileOptions {
  PolygonPolicy polygons = PolygonPolicy::plane;
  /// Of a series: selects the camera's position, the data files and the frame of a trajectory.
  std::optional<int> frame{};
  /// Of a series: what the ends of colour maps stand for where the scene file does not say it.
  ColorRanges color_ranges{};
  /// Of a series: the colours that species and other texts have already.
  KindColors kind_colors{};
  /// Of a series: the origin, where the scene file leaves it to be chosen.
  std::optional<Vec3d> origin{};
  /// Of a series: keeps trajectories open for the next frame; null: none. Not for several threads
  /// at a time.
  ParticleFileCache* particle_files = nullptr;
  bool trust = false;  ///< packed scenes are not checked (PackedOptions)
  /// Periodic images that make fewer spheres are written out (ParticleSpheres::shares_images()).
  std::optional<std::uint64_t> fewest_shared{};
  const SceneData* data = nullptr;  ///< what is taken from memory where a file is named; null: none
  /// Runs the loops over particles.
  ParallelFor parallel_for = serial_for;
};

/// A scene that has passed validate(), warnings for the user, and the paths of the data files that
/// were read besides the scene file.
struct LoadedScene {
  Scene scene{};
  std::vector<std::string> warnings{};  ///< each "FILE:LINE: warning: TEXT"
  std::vector<std::string> data_files{};
  std::vector<std::string> notes{};        ///< what was decided for the user, a sentence each
  std::vector<ParticleFacts> particles{};  ///< of each file of particles
  /// What was subtracted from all points of the scene before they were rounded: its own point 0.
  Vec3d origin{};
};

/// Reads a scene by its extension: .toml, .nff (Haines' SPD), .boule (packed), or .npy: spheres
/// alone, N x 4.
/// An error is a Diagnostic with file, line, column and key; it is an error, too, if the scene is
/// too large to be prepared in the memory there is. Takes any name, text and frame; only regular
/// files are read.
Result<LoadedScene> load_scene(const std::string& path, const SceneFileOptions& options = {});

/// Reads the text of a TOML scene as if it stood in a file at `shown_path`, which need not be
/// there: errors name it, and the names of data files are relative to its folder.
Result<LoadedScene> load_scene_text(const std::string& toml, const std::string& shown_path,
                                    const SceneFileOptions& options = {});

}  // namespace boule
