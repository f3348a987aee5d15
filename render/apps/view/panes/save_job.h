#pragma once

#include <cstdint>
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
  static Result<SaveJob> create(std::uint32_t id, Scene scene, const RenderOptions& options);

  Status step(const StepLimit& limit) { return pane_->step(limit); }
  [[nodiscard]] bool done() const { return pane_->done(); }
  [[nodiscard]] double share() const { return pane_->progress().share; }
  /// The picture as boule render makes it. Precondition: done().
  Result<Image> picture();
  [[nodiscard]] std::uint32_t id() const { return id_; }

 private:
  explicit SaveJob(std::uint32_t id) : id_(id), pane_(std::make_unique<LivePane>()) {}

  std::uint32_t id_;
  std::unique_ptr<LivePane> pane_;
};

}  // namespace boule::view
