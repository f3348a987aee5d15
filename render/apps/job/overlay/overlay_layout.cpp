#include "render/apps/job/overlay/overlay_layout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "render/apps/job/picture/legend.h"

namespace boule {
namespace {

using overlay_module::Paint;
using overlay_module::Point;

constexpr double edge_room = 7, between = 8;  // points
constexpr SrgbColor dark_text{0x22, 0x22, 0x22}, light_text{0xee, 0xee, 0xee};

struct PlacedBox {
  OverlayBox box;
  double x = 0, y = 0;  ///< its upper left corner, in points
};

struct PixelBox {
  int x0, y0, x1, y1;
};

/// 0..255, as the eye weighs colours (ITU-R BT.601), over white.
int lightness(const std::uint8_t* pixel, int channels) {
  const int own = (77 * pixel[0] + 150 * pixel[1] + 29 * pixel[2]) >> 8;
  const int alpha = channels == 4 ? pixel[3] : 255;
  return (own * alpha + 255 * (255 - alpha)) / 255;
}

/// What lies under a part: how many pixels there are of each lightness.
class Histogram {
 public:
  Histogram(const OverlayGround& ground, const PixelBox& box) {
    for (int y = box.y0; y < box.y1; ++y) {
      const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(ground.width);
      for (int x = box.x0; x < box.x1; ++x) {
        const std::size_t at =
            (row + static_cast<std::size_t>(x)) * static_cast<std::size_t>(ground.channels);
        const int light = lightness(&ground.codes[at], ground.channels);
        ++counts_[static_cast<std::size_t>(light)];
        sum_ += static_cast<std::uint64_t>(light);
        ++all_;
      }
    }
  }

  [[nodiscard]] bool is_light() const { return sum_ >= 128 * all_; }
  /// Whether more than one in a hundred is hard to tell from a text for a light ground, or a dark
  /// one.
  [[nodiscard]] bool hides_text(bool on_light) const {
    constexpr std::size_t darkest = 140, lightest = 115;
    std::uint64_t bad = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (on_light ? i < darkest : i > lightest) bad += counts_[i];
    }
    return 100 * bad > all_;
  }

 private:
  std::array<std::uint64_t, 256> counts_{};
  std::uint64_t sum_ = 0, all_ = 0;
};

PixelBox pixels_of(const PlacedBox& placed, double scale, double pixels,
                   const OverlayGround& ground) {
  const auto at = [](double x, int side) {
    return static_cast<int>(std::clamp(std::floor(x), 0.0, double(side)));
  };
  return {at(placed.x * pixels, ground.width), at(placed.y * pixels, ground.height),
          at((placed.x + placed.box.width * scale) * pixels + 1, ground.width),
          at((placed.y + placed.box.height * scale) * pixels + 1, ground.height)};
}

/// Puts a part into the drawing. `is_light`: the ground that its texts are for; none: what is under
/// it.
void put(PlacedBox placed, double scale, double pixels, const OverlayGround& ground, Drawing& all,
         std::optional<bool> is_light = {}) {
  if (placed.box.drawing.empty()) return;
  const Histogram under(ground, pixels_of(placed, scale, pixels, ground));
  const bool on_light = is_light.value_or(under.is_light());
  const bool needs_halo = under.hides_text(on_light);
  const Paint text = paint_of(on_light ? dark_text : light_text);
  for (DrawnItem& one : placed.box.drawing) {
    for (Point& point : one.points)
      point = {placed.x + point.x * scale, placed.y + point.y * scale};
    one.width *= scale;
    one.size *= scale;
    if (needs_halo) {
      one.halo = paint_of(on_light ? SrgbColor{255, 255, 255} : SrgbColor{}, 0.85);
      one.halo_width = 1.2 * scale;
    }
    if (one.fill.r == ink.r) one.fill = text;
    if (one.stroke.r == ink.r) one.stroke = text;
    all.push_back(std::move(one));
  }
}

struct Boxes {
  OverlayBox legend, time, axes, bar;
};

/// The parts for a page of this size.
Boxes boxes_of(const OverlayFacts& facts, double width, double height, const TextWidth& width_of) {
  Boxes all;
  if (facts.has(OverlayPart::axes)) all.axes = draw_axes(facts, width_of);
  if (facts.has(OverlayPart::time)) all.time = draw_time(facts, width_of);
  if (facts.has(OverlayPart::scale)) {
    const double free = width - 2 * edge_room - (all.axes.width > 0 ? all.axes.width + between : 0);
    all.bar = draw_scale_bar(facts, std::clamp(width / 4, std::min(24.0, free), 72.0), width_of);
  }
  if (facts.has(OverlayPart::legend)) {
    const double below = all.bar.height > 0 ? all.bar.height + between : 0;
    all.legend = draw_legend(facts, height - 2 * edge_room - below, width_of);
  }
  return all;
}

/// By which factor all must be smaller to fit beside and above each other.
double fitting_scale(const Boxes& all, double width, double height) {
  const auto sum = [](double a, double b) { return a + b + (a > 0 && b > 0 ? between : 0); };
  const double wide =
      std::max(sum(all.time.width, all.legend.width), sum(all.axes.width, all.bar.width));
  const double high =
      std::max(sum(all.time.height, all.axes.height), sum(all.legend.height, all.bar.height));
  constexpr double full = 150;  // points: below, texts would cover too much of the picture
  double scale = std::min(1.0, std::min(width, height) / full);
  if (wide > 0) scale = std::min(scale, (width - 2 * edge_room * scale) / wide);
  if (high > 0) scale = std::min(scale, (height - 2 * edge_room * scale) / high);
  return std::max(scale, 0.1);
}

/// A label at its particle: on it if there is room, else at its upper right.
PlacedBox placed_label(const OverlayLabel& label, double pixels, const TextWidth& width_of) {
  PlacedBox placed{draw_label(label.text, width_of)};
  const auto& [width, height] = std::pair(placed.box.width, placed.box.height);
  const double x = label.x / pixels, y = label.y / pixels, radius = label.radius / pixels;
  const bool fits = std::hypot(width, height) < 2 * radius;
  const double aside = 0.75 * radius + 1;
  placed.x = fits ? x - width / 2 : x + aside;
  placed.y = fits ? y - height / 2 : y - aside - height;
  return placed;
}

void put_labels(const OverlayFacts& facts, const OverlayGround& ground, const TextWidth& width_of,
                Drawing& all) {
  const double pixels = facts.pixels_per_point;
  const double width = ground.width / pixels, height = ground.height / pixels;
  if (facts.labels.empty()) return;
  const bool is_light = Histogram(ground, {0, 0, ground.width, ground.height}).is_light();
  std::vector<std::array<Point, 2>> taken;
  for (const OverlayLabel& label : facts.labels) {
    PlacedBox placed = placed_label(label, pixels, width_of);
    const OverlayBox& box = placed.box;
    placed.x = std::clamp(placed.x, 0.0, std::max(width - box.width, 0.0));
    placed.y = std::clamp(placed.y, 0.0, std::max(height - box.height, 0.0));
    const std::array<Point, 2> own{
        {{placed.x, placed.y}, {placed.x + box.width, placed.y + box.height}}};
    const bool covers = std::any_of(taken.begin(), taken.end(), [&](const auto& other) {
      return own[0].x < other[1].x + 1 && other[0].x < own[1].x + 1 && own[0].y < other[1].y + 1 &&
             other[0].y < own[1].y + 1;
    });
    if (covers) continue;
    taken.push_back(own);
    put(std::move(placed), 1, pixels, ground, all, is_light);
  }
}

/// About as wide as the letters of common fonts.
double estimated_width(const std::string& text, double size) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80;
  });
  return 0.6 * size * static_cast<double>(letters);
}

}  // namespace

double legend_room(const OverlayFacts& facts, int width, int height, double margin) {
  if (!facts.has(OverlayPart::legend) || !has_legend(facts.colors)) return 0;
  const double wide = width / facts.pixels_per_point, high = height / facts.pixels_per_point;
  Boxes boxes = boxes_of(facts, wide, high, estimated_width);
  const double scale = fitting_scale(boxes, wide, high);
  const double taken = (boxes.legend.width + edge_room + between) * scale / wide;
  return std::clamp(taken - margin, 0.0, 0.4);
}

Drawing lay_out(const OverlayFacts& facts, const OverlayGround& ground, const TextWidth& width_of) {
  const double pixels = facts.pixels_per_point;
  const double width = ground.width / pixels, height = ground.height / pixels;
  Boxes boxes = boxes_of(facts, width, height, width_of);
  const double scale = fitting_scale(boxes, width, height);
  if (scale < 1) {  // a bar keeps its length: it is drawn for the page that is so much larger
    OverlayFacts larger = facts;
    larger.pixels_per_point *= scale;
    boxes = boxes_of(larger, width / scale, height / scale, width_of);
  }
  Drawing all;
  put_labels(facts, ground, width_of, all);
  const double edge = edge_room * scale;
  const auto right = [&](const OverlayBox& box) { return width - edge - box.width * scale; };
  const auto bottom = [&](const OverlayBox& box) { return height - edge - box.height * scale; };
  const double legend = right(boxes.legend), bar = right(boxes.bar), low = bottom(boxes.bar);
  const double axes = bottom(boxes.axes);
  put({std::move(boxes.legend), legend, edge}, scale, pixels, ground, all);
  put({std::move(boxes.time), edge, edge}, scale, pixels, ground, all);
  put({std::move(boxes.axes), edge, axes}, scale, pixels, ground, all);
  put({std::move(boxes.bar), bar, low}, scale, pixels, ground, all);
  return all;
}

}  // namespace boule
