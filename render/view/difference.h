#pragma once

#include <vector>

#include "core/base/error.h"
#include "render/image/image.h"
#include "render/view/live_pane.h"

/// How far two panes are apart, in false colours: black where they agree, then blue, green, yellow,
/// red.
namespace boule::view {

/// By the largest difference of the three 8-bit codes that are shown: 1 is dark blue, 255 red; each
/// colour stands for 4 times the one before. Black where the sizes differ.
Image color_difference(const Image& a, const Image& b, float exposure_stops);

/// By t of the rays through the pixels' centres: how many floats lie between, each colour stands
/// for 16 times the one before; magenta where another primitive is met. Both panes show the same
/// size.
Image t_difference(const std::vector<PixelHit>& a, const std::vector<PixelHit>& b, int width,
                   int height);

/// A false colour for 0, which is black, up to 1.
Color false_color(double share);

}  // namespace boule::view
