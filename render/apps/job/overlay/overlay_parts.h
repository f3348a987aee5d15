#pragma once

#include <functional>
#include <string>

#include "render/apps/job/overlay/overlay_drawing.h"
#include "render/apps/job/overlay/overlay_facts.h"

namespace boule {

/// How wide a text of this size is, in points.
using TextWidth = std::function<double(const std::string& text, double size)>;

/// One part of an overlay, in points from its own upper left corner. Whatever has the colour of
/// `ink` gets that of the text where it comes to lie.
struct OverlayBox {
  Drawing drawing{};
  double width = 0, height = 0;
};
inline constexpr overlay_module::Paint ink{-1, -1, -1, 1};

/// The size of all texts, in points.
inline constexpr double overlay_text = 8;

/// The parts, each empty where it has nothing to tell. `room`: how high, or how wide, it may be.
OverlayBox draw_legend(const OverlayFacts& facts, double room, const TextWidth& width_of);
OverlayBox draw_scale_bar(const OverlayFacts& facts, double room, const TextWidth& width_of);
OverlayBox draw_axes(const OverlayFacts& facts, const TextWidth& width_of);
OverlayBox draw_time(const OverlayFacts& facts, const TextWidth& width_of);
/// A text alone, as high as its capital letters.
OverlayBox draw_label(const std::string& text, const TextWidth& width_of);

/// The largest of 1, 2 and 5 times a power of ten that is at most `length`. Precondition: it is
/// finite and above 0.
double round_length(double length);

}  // namespace boule
