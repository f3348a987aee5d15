#include "render/apps/job/picture/rendered_picture.h"

#include "render/frame/film.h"
#include "render/frame/partial_picture.h"
#include "render/renderer/aov_channels.h"

namespace boule {

Result<RenderedPicture> render_picture(Renderer& renderer, bool shows_first,
                                       const std::function<bool()>& may_be_unfinished) {
  const RenderOptions& options = renderer.options();
  const Alpha alpha = alpha_of(options);
  const std::uint64_t pixels = renderer.rect().area();
  // First: a picture that is stopped has its lines too.
  const auto lines = renderer.render_outline();
  if (!lines) return lines.error();
  RenderedPicture picture;
  const bool measures = is_measured(options);
  Film film(measures && !shows_first ? PixelRect{} : renderer.rect());
  MeasuredPicture measured(measures ? renderer.rect() : PixelRect{});
  const Status status = measures ? renderer.render_measured(measured, shows_first ? &film : nullptr)
                                 : renderer.render_live(film);
  if (!status && (!may_be_unfinished() || film.total_samples() == 0)) return status.error();
  if (measures) {
    if (!status) picture.partial = PartialSamples{count_measured(measured), pixels, "pixels"};
    picture.noise = noise_reached(measured, options.spp);
    picture.channels = measured_channels(options.aovs, measured);
    picture.image =
        status ? measured.image(alpha) : partial_picture(film, measured, options.order, alpha);
  } else {
    const std::uint64_t all = pixels * static_cast<std::uint64_t>(options.spp);
    if (!status) picture.partial = PartialSamples{film.total_samples(), all};
    picture.image = status ? film.to_image(alpha) : partial_picture(film, options.order, alpha);
  }
  if (options.outline > 0) lines.value().draw(picture.image);
  return picture;
}

}  // namespace boule
