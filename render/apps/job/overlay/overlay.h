#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "render/apps/job/overlay/overlay_facts.h"
#include "render/image/image.h"
#include "render/image/write_image.h"

namespace boule {

/// An error if the module that draws overlays cannot be loaded; it names the package of Debian.
Status check_overlay_module();

/// The overlay of a picture as it is shown with this exposure, to be drawn over it
/// (ImageFileOptions::layer). The same bits on one machine for any threads and instruction set;
/// machines have different fonts. An error without the module, or above 32,767 pixels a side.
Result<std::shared_ptr<const PixelLayer>> overlay_layer(const OverlayFacts& facts,
                                                        const Image& image, float exposure_stops);

/// Whether a name is that of a page, .pdf or .svg: the picture inside as an image, and what is
/// drawn on it as vectors, its text as text.
bool is_page_name(const std::string& path);

/// Writes such a page, as large as the picture in print. Exposure, date, `stop` and `temporary` of
/// `options` are as for write_image(); so are errors. The facts may be empty. A PDF needs
/// the overlay module in any case.
Status write_page(const Image& image, const OverlayFacts& facts, const std::string& path,
                  const ImageFileOptions& options);

}  // namespace boule
