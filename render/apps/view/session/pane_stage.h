#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "render/apps/view/panes/live_pane.h"
#include "render/apps/view/session/mailbox.h"
#include "render/files/scene_file/scene_file.h"
#include "render/renderer/renderer.h"

namespace boule::view {

/// What is rendered. moving: one sample of each pixel, maybe of fewer pixels. preview: the same of
/// all pixels. rest: all samples, with outlines.
enum class StageKind { moving, preview, rest };

/// The kind, and how many pixels of the full picture a pixel of it is wide and high.
struct StageShape {
  StageKind kind = StageKind::rest;
  int scale = 1;
};

/// How the machine is used.
struct WorkSettings {
  unsigned threads = 0;
  std::string isa = "auto";
};

/// The scene, and one or two panes that show it with one camera. One thread uses it.
class PaneStage {
 public:
  explicit PaneStage(WorkSettings work) : work_(std::move(work)) {}

  /// Another scene. Panes go on showing the old one until they begin anew.
  void set_scene(LoadedScene loaded);
  [[nodiscard]] const LoadedScene& loaded() const { return loaded_; }
  [[nodiscard]] const Scene& scene() const { return loaded_.scene; }

  /// The camera that the scene has or gets for a picture of this size.
  Result<Camera> scene_camera(int width, int height);
  /// The scene as it is prepared for a method, with the wish's camera at full size; null where
  /// panes are using it with another camera or size.
  Result<std::shared_ptr<const PreparedScene>> prepared(const Wish& wish, Method method);

  /// Begins anew. `overtaken` stops what is rendered at rest.
  Status begin(const Wish& wish, const StageShape& shape, const std::atomic<bool>& overtaken);

  /// Goes on for about so many seconds and pixels in each pane. An error if it was cancelled; then
  /// it must begin anew.
  Status step(const StepLimit& limit);

  [[nodiscard]] const StageShape& shape() const { return shape_; }
  [[nodiscard]] std::size_t size() const { return panes_.size(); }
  [[nodiscard]] LivePane& pane(std::size_t i) { return panes_[i]; }
  [[nodiscard]] bool started() const;
  [[nodiscard]] bool done() const;

  /// The options with which a pane is rendered, at full size and quality.
  [[nodiscard]] RenderOptions options(const Wish& wish, std::size_t pane) const;
  /// Seconds that a sample takes in all panes together, as measured last; 0: not known.
  [[nodiscard]] double sample_seconds() const { return sample_seconds_; }

 private:
  /// A scene that is prepared, and for what.
  struct Prepared {
    std::shared_ptr<PreparedScene> scene;
    std::uint32_t camera_revision = 0;
    int width = 0, height = 0;
  };

  Result<std::shared_ptr<PreparedScene>> prepare_for(Method method, const Wish& wish, int scale);
  Status prepare_anew(Prepared& kept, Method method, const std::optional<Camera>& camera,
                      float fog);
  void measure();

  const WorkSettings work_;
  LoadedScene loaded_;
  std::array<Prepared, names<Method>.size()> prepared_;  ///< by method
  std::vector<LivePane> panes_;
  StageShape shape_;
  double sample_seconds_ = 0;
};

}  // namespace boule::view
