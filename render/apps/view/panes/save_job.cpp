#include "render/apps/view/panes/save_job.h"

#include <utility>

#include "render/frame/scheduler.h"

namespace boule::view {

Result<SaveJob> SaveJob::create(Scene scene, const RenderOptions& options) {
  Scheduler scheduler(options.threads);
  auto prepared = prepare(std::move(scene), options.width, options.height, scheduler.parallel_for(),
                          options.method);
  if (!prepared) return prepared.error();
  if (options.transparent) prepared.value().backdrop = Color{};
  SaveJob job;
  if (auto done = job.pane_->start(
          std::make_shared<const PreparedScene>(std::move(prepared).value()), options);
      !done)
    return done.error();
  return job;
}

Result<Image> SaveJob::picture() {
  if (auto done = pane_->find_outline(); !done) return done.error();
  return pane_->picture();
}

}  // namespace boule::view
