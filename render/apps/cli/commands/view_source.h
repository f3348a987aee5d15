#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "render/apps/job/scene_loader.h"
#include "render/apps/view/session/scene_source.h"
#include "render/files/scene_file/loaded/particle_file_cache.h"
#include "render/files/scene_file/scene_file.h"
#include "render/frame/scheduler.h"

namespace boule::cli {

/// The file that `boule view` shows: a scene, a series of them, or particles, for which a scene is
/// made as by `boule render`. A series chooses once, as there (SceneLoader), but from fewer frames
/// where it is large: somebody is waiting.
class ViewSource final : public view::SceneSource {
 public:
  explicit ViewSource(const RenderJob& job);

  /// Finds out what the file is; reads a particle file for that.
  Status open();

  [[nodiscard]] const view::SourceFacts& facts() const override { return facts_; }
  Result<LoadedScene> load(const view::ParticleLook& look, int frame) override;
  std::vector<view::NumberRange> columns() override;
  [[nodiscard]] std::string options_of(const view::ParticleLook& look, int frame) const override;

 private:
  Status find_frames();
  void make_loader();
  [[nodiscard]] std::string radius_option() const;
  [[nodiscard]] Result<LookOptions> look_with(const view::ParticleLook& look) const;

  const RenderJob job_;
  Scheduler scheduler_;
  ParticleFileCache files_;
  std::unique_ptr<SceneLoader> loader_;  ///< once it is open
  view::SourceFacts facts_;
  std::optional<std::vector<view::NumberRange>> columns_;
  std::optional<ParticleFacts> particles_;  ///< of the frame that was read
};

/// The text as one word of a shell.
std::string shell_word(const std::string& text);

}  // namespace boule::cli
