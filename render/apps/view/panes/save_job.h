#pragma once

#include <memory>
#include <optional>

#include "core/base/error.h"
#include "render/apps/view/panes/live_pane.h"
#include "render/renderer/renderer.h"

namespace boule::view {

/// A picture at full quality that is rendered beside what is shown, in steps. It has a scene of its
/// own: the camera may go on moving.
class SaveJob {
 public:
  /// `scene` has the camera; the options are those of the picture.
  static Result<SaveJob> create(Scene scene, const RenderOptions& options);

  Status step(const StepLimit& limit) { return pane_->step(limit); }
  [[nodiscard]] bool done() const { return pane_->done(); }
  [[nodiscard]] double share() const { return pane_->progress().share; }
  /// The picture as boule render makes it. Precondition: done().
  Result<Image> picture();

 private:
  SaveJob() : pane_(std::make_unique<LivePane>()) {}

  std::unique_ptr<LivePane> pane_;
};

}  // namespace boule::view
