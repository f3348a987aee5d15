#pragma once

#include <cstdint>
#include <vector>

#include "render/apps/job/overlay/overlay_parts.h"

namespace boule {

/// The picture under an overlay, in 8 bits: 3 or 4 codes a pixel, row 0 on top.
struct OverlayGround {
  int width, height, channels;
  const std::vector<std::uint8_t>& codes;
};

/// All parts at their places: the legend at the upper right, the time at the upper left, the axes
/// at the lower left, the scale bar at the lower right. Text is dark on a light ground and light on
/// a dark one, each part by the mean of the pixels under it; transparent ones count as white. A
/// part on a ground of both gets a halo. On pictures of less than 150 points a side, and where they
/// do not fit together, parts are smaller, all by the same factor.
/// Labels are on their particles, or beside small ones; one that would cover a nearer one is left
/// out.
Drawing lay_out(const OverlayFacts& facts, const OverlayGround& ground, const TextWidth& width_of);

/// How much of the width of a picture of these pixels a camera leaves free for the legend, besides
/// its margin (CameraFit::room); 0 without one, at most 0.4. Widths of texts are estimated.
double legend_room(const OverlayFacts& facts, int width, int height, double margin);

}  // namespace boule
