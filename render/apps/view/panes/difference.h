#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/math/srgb.h"
#include "render/apps/view/panes/live_pane.h"
#include "render/image/image.h"

/// How far two panes are apart, in false colours: black where they agree, then blue, green, yellow,
/// red, each for so many times the difference of the one before.
namespace boule::view {

/// A picture of a difference, and its figures.
struct DifferencePicture {
  Image image;
  std::size_t pixels = 0;  ///< that differ
  double largest = 0;      ///< difference
};

/// By the largest difference of the three 8-bit codes that are shown: 1 is blue, 64 and more red.
/// Black where the sizes differ.
DifferencePicture color_difference(const Image& a, const Image& b, float exposure_stops);

/// By t of the rays through the pixels' centres: how many floats lie between them, 1 is blue, 4096
/// and more red; `other_primitive` where another primitive is met, which `largest` leaves out. Both
/// panes show the same size.
DifferencePicture t_difference(const std::vector<PixelHit>& a, const std::vector<PixelHit>& b,
                               int width, int height);

/// From 0, which is black, up to 1; evenly spaced, and straight lines between them.
inline constexpr std::array<SrgbColor, 5> false_colors{
    {{0, 0, 0}, {38, 84, 214}, {32, 160, 80}, {240, 214, 48}, {224, 36, 28}}};
inline constexpr SrgbColor other_primitive{255, 0, 216};
/// By how much each colour's difference is that of the one before.
inline constexpr int color_factor = 4, ulp_factor = 16;

}  // namespace boule::view
