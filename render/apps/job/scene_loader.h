#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scene/camera.h"
#include "render/apps/job/particle_look.h"
#include "render/apps/job/render_job.h"
#include "render/apps/job/series_survey.h"
#include "render/apps/job/turntable.h"
#include "render/files/scene_file/loaded/particle_file_cache.h"
#include "render/files/scene_file/scene_file.h"
#include "render/frame/scheduler.h"

namespace boule {

/// Reads the scene that a command names, or makes that of a particle file; in a series anew for
/// each frame. What the scene leaves to be chosen is chosen once for a series, from all of its
/// frames, so that nothing jumps from frame to frame: radii, what colours mean, the origin of
/// coordinates, the floor, the camera, the depth of fog.
class SceneLoader {
 public:
  /// How much of a series is read for its choices: about ten seconds.
  static constexpr std::uint64_t most_spheres = 50'000'000;

  /// `files`, if not null, keeps the files of particles open. `data`, if not null, has what stands
  /// in memory in place of files; the job's scene may name particles there. Both outlive the
  /// loader.
  explicit SceneLoader(const RenderJob& job, ParticleFileCache* files = nullptr,
                       std::uint64_t most = most_spheres, const SceneData* data = nullptr);
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  /// The scene of a frame, or that of a single picture. Whichever frame comes first, the choices
  /// are those of all: processes that share a series make the same ones.
  Result<LoadedScene> load(std::optional<int> frame);
  /// The same where particles look otherwise from now on, unless that is an error.
  Result<LoadedScene> load_as(const LookOptions& look, std::optional<int> frame);

  /// From now on LoadedScene::source may have the spheres of particles, for one who needs them in
  /// their order only. This object outlives that source.
  void let_stream() { options_.may_stream = !look_.floor; }

  /// Whether a scene was made for a particle file.
  [[nodiscard]] bool is_made() const { return is_made_; }
  /// What colours mean, one for each table of particles: those of a series include what is only in
  /// some of its frames.
  [[nodiscard]] const std::vector<ParticleColors>& colors() const { return choices_.colors; }
  /// What was chosen for the tables of a series.
  [[nodiscard]] const SeriesChoices& particle_choices() const { return choices_.particles; }

 private:
  /// What is chosen once.
  struct Choices {
    bool are_made = false;
    std::optional<Vec3d> origin;
    SeriesChoices particles;
    std::vector<ParticleColors> colors;
    std::optional<LookFloor> floor;   ///< of a particle file
    std::optional<Camera> camera;     ///< if the scene has none
    std::optional<SphereBounds> box;  ///< from which fog has its depths
    std::optional<Turntable> table;   ///< if it turns
    std::vector<std::string> notes;   ///< that are still to be told
  };

  [[nodiscard]] bool shows_particle_file(const std::string& path) const;
  Result<LoadedScene> load_turned(int step);
  Result<LoadedScene> read(std::optional<int> frame);
  Result<LoadedScene> read_file(std::optional<int> frame);
  Result<LoadedScene> choose_for_series();
  [[nodiscard]] FrameRange whole_frames() const;
  [[nodiscard]] std::uint64_t find_shown(const LoadedScene& first);
  [[nodiscard]] bool needs_others(const LoadedScene& first) const;
  SeriesSurvey look_at(const std::vector<int>& frames, SeriesSurvey survey);
  void keep_floor_and_camera(const SeriesSurvey& survey, std::size_t frames);
  void keep_colors(const LoadedScene& shown);
  void use_choices(LoadedScene& loaded);
  void use_fog(Scene& scene) const;

  const std::string path_;  ///< with a slot for the frame's number
  LookOptions look_;
  const std::string camera_keys_;
  const std::optional<FrameRange> frames_;  ///< of a series of two frames or more
  const int interpolate_;
  const std::optional<int> turn_;
  const SizeChoice size_;
  const std::optional<OverlayParts> overlay_;
  const std::uint64_t most_;
  Scheduler scheduler_;
  ParticleFileCache own_files_;
  SceneFileOptions options_;
  Choices choices_;
  bool is_made_ = false;
};

}  // namespace boule
