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
Drawing lay_out(const OverlayFacts& facts, const OverlayGround& ground, const TextWidth& width_of);

}  // namespace boule
