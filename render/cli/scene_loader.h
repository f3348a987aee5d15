#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/camera.h"
#include "render/cli/exit_code.h"
#include "render/cli/options.h"
#include "render/cli/particle_look.h"
#include "render/frame/scheduler.h"
#include "render/scene_file/particle_file_cache.h"
#include "render/scene_file/scene_file.h"

namespace boule::cli {

/// Reads the scene that a command names, or makes that of a particle file; in a series anew for
/// each frame. What the scene leaves to be chosen is chosen once for a series, so that nothing
/// jumps from frame to frame: the camera, which is fitted to all frames, what colours mean, the
/// origin of coordinates, the floor.
class SceneLoader {
 public:
  explicit SceneLoader(const RenderCommand& command);
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  /// The scene of a frame, or that of a single picture. Where a series does not begin with its
  /// first frame, because other processes share it, that is read first: all make the same choices.
  Result<LoadedScene> load(std::optional<int> frame);

  /// Whether a scene was made for a particle file.
  [[nodiscard]] bool is_made() const { return is_made_; }
  /// What colours mean, one for each table of particles: those of a series include what is only in
  /// its other frames.
  [[nodiscard]] const std::vector<ParticleColors>& colors() const { return colors_; }

 private:
  Result<LoadedScene> read(std::optional<int> frame);
  Result<LoadedScene> read_file(std::optional<int> frame);
  Result<LoadedScene> choose_for_series(LoadedScene first);
  void keep_choices(const LoadedScene& loaded);
  [[nodiscard]] bool needs_others(const LoadedScene& first) const;
  void look_at_others(LoadedScene& first, const std::vector<int>& frames);
  void use_choices(LoadedScene& loaded) const;

  const std::string path_;  ///< with a slot for the frame's number
  const LookOptions look_;
  const std::string camera_keys_;
  const std::optional<FrameRange> frames_;  ///< of a series of two frames or more
  const std::optional<Size> size_;
  Scheduler scheduler_;
  ParticleFileCache files_;
  SceneFileOptions options_;
  std::optional<LookFloor> floor_;  ///< of a series of a particle file
  std::optional<Camera> camera_;    ///< of a series whose scene has none
  std::vector<ParticleColors> colors_;
  bool is_first_ = true;
  bool is_made_ = false;
};

/// The exit status for an error of load(): options have keys that begin with "--".
ExitCode code_of_loading(const Diagnostic& error);

}  // namespace boule::cli
