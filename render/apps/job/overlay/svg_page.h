#pragma once

#include <string>

#include "core/base/error.h"
#include "render/apps/job/overlay/overlay_drawing.h"
#include "render/image/image.h"
#include "render/image/write_image.h"

namespace boule {

/// A picture and what is drawn on it as SVG, with text as text, as large as in print. The picture
/// inside is a PNG; exposure and `stop` of `options` are as for write_image().
Result<std::string> svg_page(const Drawing& drawing, const Image& image, double pixels_per_point,
                             const ImageFileOptions& options);

}  // namespace boule
