#include "render/apps/job/render_job.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "render/apps/job/options/render_choices.h"

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

/// Lines that are printed are no finer than what a printer draws well.
void choose_outline(const std::optional<OutlineWidth>& outline, const SizeChoice& size,
                    RenderOptions& options) {
  constexpr double finest = 0.35;  // points
  const auto pixels_of = [&](double points) {
    return static_cast<float>(points / 72 * size.pixels_per_inch());
  };
  if (outline) {
    const auto width = static_cast<double>(outline->width);
    options.outline = outline->in_points ? pixels_of(width) : outline->width;
  } else if (size.is_printed() && options.outline > 0) {
    options.outline = std::max(options.outline, pixels_of(finest));
  }
}

}  // namespace

Size SizeChoice::of(const ImageSettings& image) const {
  const Size given = shape.value_or(Size{image.width, image.height});
  if (!width) return given;
  constexpr double most = std::numeric_limits<int>::max();
  const auto whole = [most](double pixels) {
    return static_cast<int>(std::clamp(std::floor(pixels + 0.5), 1.0, most));
  };
  const double pixels = *width / 25.4 * pixels_per_inch();
  return {whole(pixels), whole(pixels * given.height / given.width)};
}

SizeChoice size_choice(const RenderJob& job) { return {job.size, job.width, job.dpi}; }

RenderOptions options_of(const RenderJob& job, const Scene& scene) {
  RenderOptions options = options_of(scene);
  const auto put_all = [&](const auto&... row) { (put(row, job, options), ...); };
  std::apply(put_all, scene_choices());
  std::apply(put_all, render_choices());
  const SizeChoice size = size_choice(job);
  const auto [width, height] = size.of(scene.image);
  options.width = width;
  options.height = height;
  choose_outline(job.outline, size, options);
  choose_samples({job.spp, job.noise, job.aa}, options);
  const PixelOrder usual = job.partial ? PixelOrder::progressive : PixelOrder::tiles;
  options.order = job.order.value_or(usual);
  return options;
}

OverlayParts overlay_of(const RenderJob& job, const Scene& scene) {
  return job.overlay.value_or(scene.image.overlay);
}

void choose_background(const std::optional<BackgroundChoice>& choice, Scene& scene) {
  if (!choice) return;
  scene.image.transparent = !choice->color;
  if (choice->color) scene.backdrop = linear_of(*choice->color);
}

}  // namespace boule
