#include "render/apps/job/render_job.h"

#include <tuple>

#include "render/apps/job/render_choices.h"

namespace boule {
namespace {

template <class Row>
void put(const Row& row, const RenderJob& job, RenderOptions& options) {
  if constexpr (!std::is_same_v<decltype(row.to), Nowhere>) {
    const auto& chosen = job.*row.member;
    if constexpr (requires { chosen.has_value(); }) {
      if (chosen) options.*row.to = *chosen;
    } else {
      options.*row.to = chosen;
    }
  }
}

}  // namespace

RenderOptions options_of(const RenderJob& job, const Scene& scene) {
  RenderOptions options = options_of(scene);
  const auto put_all = [&](const auto&... row) { (put(row, job, options), ...); };
  std::apply(put_all, scene_choices());
  std::apply(put_all, render_choices());
  if (job.size) {
    options.width = job.size->width;
    options.height = job.size->height;
  }
  choose_samples({job.spp, job.noise, job.aa}, options);
  const PixelOrder usual = job.partial ? PixelOrder::progressive : PixelOrder::tiles;
  options.order = job.order.value_or(usual);
  return options;
}

void choose_background(const std::optional<BackgroundChoice>& choice, Scene& scene) {
  if (!choice) return;
  scene.image.transparent = !choice->color;
  if (choice->color) scene.backdrop = linear_of(*choice->color);
}

}  // namespace boule
