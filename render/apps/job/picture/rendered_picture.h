#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "render/apps/job/picture/picture_header.h"
#include "render/frame/measured_picture.h"
#include "render/image/image.h"
#include "render/renderer/renderer.h"

namespace boule {

/// A picture as far as it is, and what there is to tell of it.
struct RenderedPicture {
  Image image{};
  std::vector<ImageChannel> channels{};     ///< those that tell of its noise
  std::optional<PartialSamples> partial{};  ///< none: it is finished
  std::optional<NoiseReached> noise{};      ///< none: it was not measured
};

/// Renders a picture with its lines; an unfinished one if it is stopped, `may_be_unfinished()` is
/// true then, and there is something to see. `shows_first`: where noise is measured, each pixel has
/// a sample before any gets all, so that there is.
Result<RenderedPicture> render_picture(Renderer& renderer, bool shows_first,
                                       const std::function<bool()>& may_be_unfinished);

}  // namespace boule
