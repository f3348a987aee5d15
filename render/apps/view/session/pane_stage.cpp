#include "render/apps/view/session/pane_stage.h"

#include <algorithm>
#include <utility>

#include "render/frame/scheduler.h"
#include "render/prepare/default_camera.h"

namespace boule::view {
namespace {

/// Blocks that are small enough to be seen one after the other.
constexpr int tile_at_pace = 8, tile_at_rest = 32;

int scaled(int side, int scale) { return (side + scale - 1) / scale; }

}  // namespace

void PaneStage::set_scene(LoadedScene loaded) {
  loaded_ = std::move(loaded);
  for (auto& one : prepared_) one = {};
  sample_seconds_ = 0;
}

/// A scene that is prepared for this is kept for the first picture.
Result<Camera> PaneStage::scene_camera(int width, int height) {
  if (scene().camera) return *scene().camera;
  Prepared first{nullptr, 0, width, height};
  const float fog = scene().image.fog;
  if (auto done = prepare_anew(first, scene().render.method, {}, fog); !done) return done.error();
  const Camera camera = first.scene->camera;
  prepared_[static_cast<std::size_t>(scene().render.method)] = std::move(first);
  return camera;
}

/// `fog`: as Scene's.
Status PaneStage::prepare_anew(Prepared& kept, Method method, const std::optional<Camera>& camera,
                               float fog) {
  Scene copy = scene();
  copy.image.fog = fog;
  if (camera) copy.camera = camera;
  Scheduler scheduler(work_.threads);
  auto made = prepare(std::move(copy), kept.width, kept.height, scheduler.parallel_for(), method);
  if (!made) return made.error();
  kept.scene = std::make_shared<PreparedScene>(std::move(made).value());
  if (scene().image.transparent) kept.scene->backdrop = Color{};
  return {};
}

/// A scene that fits already is left alone: panes may be using it.
Result<std::shared_ptr<PreparedScene>> PaneStage::prepare_for(Method method, const Wish& wish,
                                                              int scale) {
  Prepared& kept = prepared_[static_cast<std::size_t>(method)];
  Prepared wanted{kept.scene, wish.camera_revision, scaled(wish.settings.width, scale),
                  scaled(wish.settings.height, scale)};
  const bool fits = kept.scene && kept.camera_revision == wanted.camera_revision &&
                    kept.width == wanted.width && kept.height == wanted.height;
  // Fog needs the bounds of the scene, which it is prepared with once it has some.
  const bool lacks_bounds = kept.scene && wish.settings.fog > 0 && !kept.scene->bounds;
  if (fits && !lacks_bounds) return kept.scene;
  if (lacks_bounds) wanted.scene.reset();
  kept.scene.reset();  // not half of what was and half of what is to be, if this fails
  auto done = wanted.scene ? reframe(*wanted.scene, wish.camera, wanted.width, wanted.height)
                           : prepare_anew(wanted, method, wish.camera, wish.settings.fog);
  if (!done) return done.error();
  kept = std::move(wanted);
  return kept.scene;
}

Result<std::shared_ptr<const PreparedScene>> PaneStage::prepared(const Wish& wish, Method method) {
  const Prepared& kept = prepared_[static_cast<std::size_t>(method)];
  const bool fits = kept.camera_revision == wish.camera_revision &&
                    kept.width == wish.settings.width && kept.height == wish.settings.height;
  const bool used = std::any_of(panes_.begin(), panes_.end(), [&](const LivePane& pane) {
    return pane.started() && &pane.scene() == kept.scene.get();
  });
  if (kept.scene && used && !fits) return std::shared_ptr<const PreparedScene>();
  auto made = prepare_for(method, wish, 1);
  if (!made) return made.error();
  return std::shared_ptr<const PreparedScene>(made.value());
}

RenderOptions PaneStage::options(const Wish& wish, std::size_t pane) const {
  const PaneSettings& chosen = wish.settings.panes[pane];
  RenderOptions options = options_of(scene());
  options.width = wish.settings.width;
  options.height = wish.settings.height;
  options.spp = wish.settings.spp;
  options.noise = options.aa = 0;  // films leave them aside, and `spp` may be anything
  options.max_depth = wish.settings.max_depth;
  options.outline = wish.settings.outline;
  options.fog = wish.settings.fog;
  options.order = chosen.order;
  options.solver = chosen.solver;
  options.method = chosen.method;
  options.shadow_epsilon = chosen.shadow_epsilon;
  options.threads = work_.threads;
  options.isa = work_.isa;
  if (wish.settings.difference == Difference::ulp) options.aovs.depth = options.aovs.id = true;
  return options;
}

Status PaneStage::begin(const Wish& wish, const StageShape& shape,
                        const std::atomic<bool>& overtaken) {
  measure();
  if (panes_.size() != wish.settings.panes.size()) {
    panes_.clear();
    panes_.resize(wish.settings.panes.size());
  }
  shape_ = shape;
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    RenderOptions options = this->options(wish, i);
    options.width = scaled(options.width, shape.scale);
    options.height = scaled(options.height, shape.scale);
    options.tile = wish.settings.pace > 0 ? tile_at_pace : tile_at_rest;
    if (shape.kind == StageKind::rest) {
      options.cancel = &overtaken;
    } else {
      options.spp = 1;
      options.outline = 0;
    }
    auto ready = prepare_for(options.method, wish, shape.scale);
    if (!ready) return ready.error();
    if (auto done = panes_[i].start(std::move(ready).value(), options); !done) return done;
  }
  return {};
}

Status PaneStage::step(const StepLimit& limit) {
  StepLimit share = limit;
  share.seconds = limit.seconds / static_cast<double>(panes_.size());
  for (LivePane& pane : panes_) {
    if (pane.done()) continue;
    if (auto done = pane.step(share); !done) return done;
    if (pane.done()) {
      if (auto done = pane.find_outline(); !done) return done;
    }
  }
  return {};
}

bool PaneStage::started() const {
  return !panes_.empty() && std::all_of(panes_.begin(), panes_.end(),
                                        [](const LivePane& pane) { return pane.started(); });
}

bool PaneStage::done() const {
  return std::all_of(panes_.begin(), panes_.end(),
                     [](const LivePane& pane) { return pane.done(); });
}

/// From what was rendered since the last beginning, where that is enough to tell.
void PaneStage::measure() {
  double seconds = 0;
  for (const LivePane& pane : panes_) {
    const LivePane::Progress progress = pane.progress();
    if (progress.samples < 1000) return;
    seconds += progress.seconds / static_cast<double>(progress.samples);
  }
  if (seconds > 0) sample_seconds_ = seconds;
}

}  // namespace boule::view
