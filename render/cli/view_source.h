#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "render/cli/options.h"
#include "render/frame/scheduler.h"
#include "render/scene_file/particle_file_cache.h"
#include "render/scene_file/scene_file.h"
#include "render/view/scene_source.h"

namespace boule::cli {

/// The file that `boule view` shows: a scene, a series of them, or particles, for which a scene is
/// made as by `boule render`. What is chosen for the first frame stays for the others: the origin
/// and the range of colours.
class ViewSource final : public view::SceneSource {
 public:
  explicit ViewSource(const RenderCommand& command);

  /// Finds out what the file is; reads a particle file for that.
  Status open();

  [[nodiscard]] const view::SourceFacts& facts() const override { return facts_; }
  Result<LoadedScene> load(const view::ParticleLook& look, int frame) override;
  std::vector<view::NumberRange> columns() override;
  [[nodiscard]] std::string options_of(const view::ParticleLook& look, int frame) const override;

 private:
  Result<LoadedScene> read(const LookOptions& look, int frame);
  Status find_frames();
  [[nodiscard]] Result<LookOptions> look_with(const view::ParticleLook& look) const;

  const RenderCommand command_;
  Scheduler scheduler_;
  ParticleFileCache files_;
  SceneFileOptions options_;
  view::SourceFacts facts_;
  std::optional<view::ParticleLook> last_look_;
  std::optional<std::vector<view::NumberRange>> columns_;
  std::optional<ParticleFacts> particles_;  ///< of the frame that was read
};

}  // namespace boule::cli
