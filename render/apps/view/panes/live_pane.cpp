#include "render/apps/view/panes/live_pane.h"

#include <utility>

#include "render/frame/partial_picture.h"

namespace boule::view {
namespace {

/// Fills the pixels without samples with those of another picture, which may have another size.
void fill_gaps(Image& image, const Film& film, const Image& before) {
  if (before.pixels.empty()) return;
  const PixelRect& rect = film.rect();
  for (int y = 0; y < image.height; ++y) {
    const int from_y = y * before.height / image.height;
    for (int x = 0; x < image.width; ++x) {
      if (film.samples(rect.x0 + x, rect.y0 + y) > 0) continue;
      const std::size_t from = before.index(x * before.width / image.width, from_y);
      image.set(image.index(x, y), before.pixels[from],
                before.alpha.empty() ? 1.0F : before.alpha[from]);
    }
  }
}

}  // namespace

Status LivePane::start(std::shared_ptr<const PreparedScene> scene, const RenderOptions& options) {
  LivePosition begin;
  if (renderer_) {
    if (position_.pass > 0 || position_.block > 0) before_ = picture();
    if (renderer_->options().order == options.order) begin = renderer_->restarted(position_);
  }
  auto created = Renderer::create(std::move(scene), options);
  if (!created) return created.error();
  renderer_.emplace(std::move(created).value());
  if (film_) {
    film_->restart(renderer_->rect());
  } else {
    film_.emplace(renderer_->rect());
  }
  outline_.reset();
  position_ = begin;
  return {};
}

Status LivePane::step(const StepLimit& limit) {
  return renderer_->render_step(*film_, position_, limit);
}

Status LivePane::find_outline() {
  if (!(renderer_->options().outline > 0)) return {};
  auto lines = renderer_->render_outline();
  if (!lines) return lines.error();
  outline_.emplace(std::move(lines).value());
  return {};
}

/// Order progressive fills its gaps by itself, once its coarsest pass is done.
Image LivePane::picture() const {
  const RenderOptions& options = renderer_->options();
  const Alpha alpha = alpha_of(options);
  const bool coarse = options.order == PixelOrder::progressive && position_.pass > 0 &&
                      position_.pass < LivePasses::coarse_passes;
  Image image = coarse ? partial_picture(*film_, options.order, alpha) : film_->to_image(alpha);
  if (!coarse && !done()) fill_gaps(image, *film_, before_);
  if (outline_) outline_->draw(image);
  return image;
}

Result<std::vector<PixelHit>> LivePane::hits() {
  auto channels = renderer_->render_aovs();
  if (!channels) return channels.error();
  const auto& depths = std::get<std::vector<float>>(channels.value().front().samples);
  const auto& ids = std::get<std::vector<std::uint32_t>>(channels.value().back().samples);
  std::vector<PixelHit> hits;
  hits.reserve(depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) hits.push_back({depths[i], ids[i]});
  return hits;
}

void LivePane::forget() {
  before_ = {};
  renderer_.reset();
}

LivePane::Progress LivePane::progress() const {
  if (!renderer_) return {};
  const RenderStatistics statistics = renderer_->statistics();
  return {static_cast<std::uint32_t>(position_.pass), film_->total_samples(),
          statistics.rays.total(), renderer_->share_done(position_), statistics.render_seconds};
}

}  // namespace boule::view
