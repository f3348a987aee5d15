#pragma once

#include <string>
#include <vector>

#include "core/math/srgb.h"
#include "render/apps/job/overlay/overlay_module.h"

namespace boule {

/// Something to draw (overlay_module::Item), with what it points to.
struct DrawnItem {
  overlay_module::Shape shape = overlay_module::Shape::path;
  std::vector<overlay_module::Point> points{};
  overlay_module::Paint fill{};
  overlay_module::Paint stroke{};
  double width = 0;
  double size = 0;
  overlay_module::Paint halo{};
  double halo_width = 0;
  std::string text{};
  std::vector<overlay_module::Paint> colors{};
};
using Drawing = std::vector<DrawnItem>;

/// The drawing as the module takes it; it points into the drawing.
std::vector<overlay_module::Item> items_of(const Drawing& drawing);

constexpr overlay_module::Paint paint_of(SrgbColor color, double alpha = 1) {
  return {color.r / 255.0, color.g / 255.0, color.b / 255.0, alpha};
}

/// A text as a drawing may have it: UTF-8, in which what is broken and control bytes are question
/// marks.
std::string drawable(const std::string& text);

}  // namespace boule
