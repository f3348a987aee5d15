#include "render/apps/job/overlay/overlay_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "render/apps/job/picture/legend.h"

namespace boule {
namespace {

using overlay_module::Paint;
using overlay_module::Point;
using overlay_module::Shape;

// In points.
constexpr double row_step = 11, dot_size = 3.2, gap = 4, line = 0.6;
constexpr double bar_across = 8, longest_bar = 90, shortest_bar = 30, arrow = 6, tick = 2.5;
constexpr std::size_t most_rows = 40;

void add_text(OverlayBox& box, double left, double middle, const std::string& text,
              const TextWidth& width_of) {
  const std::string shown = drawable(text);
  box.drawing.push_back({.shape = Shape::text,
                         .points = {{left, middle}},
                         .fill = ink,
                         .size = overlay_text,
                         .text = shown});
  box.width = std::max(box.width, left + width_of(shown, overlay_text));
}

void add_line(OverlayBox& box, std::vector<Point> points, double width = line, Paint paint = ink) {
  box.drawing.push_back({.points = std::move(points), .stroke = paint, .width = width});
}

/// An end of a bar for what lies beyond it.
void add_arrow(OverlayBox& box, double base, double tip, SrgbColor color) {
  box.drawing.push_back({.points = {{0, base}, {bar_across / 2, tip}, {bar_across, base}},
                         .fill = paint_of(color),
                         .stroke = ink,
                         .width = line});
}

void add_bar(OverlayBox& box, const ParticleColors::Scale& scale, double room,
             const TextWidth& width_of) {
  add_text(box, 0, box.height + row_step / 2, legend_title(scale), width_of);
  const double title = box.height + row_step + 3;
  const double above = scale.goes_above ? arrow : 0, below = scale.goes_below ? arrow : 0;
  const double free = room - title - above - below - row_step / 2;
  const double top = title + above, height = std::clamp(free, shortest_bar, longest_bar);
  DrawnItem bar{.shape = Shape::ramp,
                .points = {{0, top}, {bar_across, top + height}},
                .stroke = ink,
                .width = line};
  constexpr int stops = 64;
  for (int i = 0; i <= stops; ++i)
    bar.colors.push_back(paint_of(scale.map.color(static_cast<double>(i) / stops)));
  box.drawing.push_back(std::move(bar));
  if (scale.goes_above) add_arrow(box, top, top - arrow, scale.map.color(1));
  if (scale.goes_below) add_arrow(box, top + height, top + height + arrow, scale.map.color(0));
  const auto [low, high] = scale.range;
  const auto ticks = legend_ticks(low, high);
  // On a short bar every second or third number has its place.
  const double apart = height / static_cast<double>(std::max<std::size_t>(ticks.size(), 1));
  const auto every = static_cast<std::size_t>(std::ceil(row_step / apart));
  for (std::size_t i = 0; i < ticks.size(); i += every) {
    const double y = top + height * (high - ticks[i].number) / (high - low);
    add_line(box, {{bar_across, y}, {bar_across + tick, y}});
    add_text(box, bar_across + tick + 2, y, ticks[i].text, width_of);
  }
  box.height = top + height + below + row_step / 2;
}

void add_rows(OverlayBox& box, const std::vector<ParticleColors::Species>& all, double room,
              const TextWidth& width_of) {
  const double free = std::max(room - box.height, row_step);
  const auto fitting = std::clamp<std::size_t>(static_cast<std::size_t>(free / row_step), 1, 20);
  const std::size_t shown = std::min(all.size(), most_rows);
  const std::size_t columns = (shown + fitting - 1) / fitting;
  const std::size_t rows = (shown + columns - 1) / columns;
  double left = 0;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0 && i % rows == 0) left = box.width + 2 * gap;
    const double y = box.height + (static_cast<double>(i % rows) + 0.5) * row_step;
    box.drawing.push_back({.shape = Shape::disc,
                           .points = {{left + dot_size, y}},
                           .fill = paint_of(all[i].color),
                           .stroke = ink,
                           .width = line / 2,
                           .size = dot_size});
    add_text(box, left + 2 * dot_size + gap, y, all[i].name, width_of);
  }
  box.height += static_cast<double>(rows) * row_step;
  if (shown == all.size()) return;
  add_text(box, 0, box.height + row_step / 2, fmt::format("and {} more", all.size() - shown),
           width_of);
  box.height += row_step;
}

/// The box with its drawing at the corner, as large as that.
OverlayBox moved_to_corner(OverlayBox box, const TextWidth& width_of) {
  Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const DrawnItem& item : box.drawing) {
    const bool is_text = item.shape == Shape::text;
    const double around = is_text ? 0 : item.size + item.width / 2;
    const double right = is_text ? width_of(item.text, item.size) : around;
    const double up = is_text ? 0.4 * item.size : around,
                 down = is_text ? 0.55 * item.size : around;
    for (const auto& [x, y] : item.points) {
      low = {std::min(low.x, x - around), std::min(low.y, y - up)};
      high = {std::max(high.x, x + right), std::max(high.y, y + down)};
    }
  }
  for (DrawnItem& item : box.drawing) {
    for (Point& point : item.points) point = {point.x - low.x, point.y - low.y};
  }
  box.width = high.x - low.x;
  box.height = high.y - low.y;
  return box;
}

}  // namespace

double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  double round = power;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (factor * power <= length) round = factor * power;
  }
  return round;
}

OverlayBox draw_legend(const OverlayFacts& facts, double room, const TextWidth& width_of) {
  OverlayBox box;
  for (const ParticleColors& colors : facts.colors) {
    const auto rows = legend_rows(colors);
    const double below = static_cast<double>(rows.size()) * row_step;
    if (colors.scale) add_bar(box, *colors.scale, room - (rows.empty() ? 0 : below), width_of);
    if (!rows.empty()) add_rows(box, rows, room, width_of);
  }
  return box;
}

OverlayBox draw_scale_bar(const OverlayFacts& facts, double room, const TextWidth& width_of) {
  OverlayBox box;
  if (!facts.pixels_per_length) return box;
  const double points = *facts.pixels_per_length / facts.pixels_per_point;
  if (!(points > 0 && std::isfinite(room / points))) return box;
  const double length = round_length(room / points), width = length * points;
  const std::string text =
      fmt::format("{:g}{}", length, facts.unit.empty() ? "" : " " + facts.unit);
  box.width = width;
  const double of_text = width_of(text, overlay_text);
  const double left = std::max(0.0, (of_text - width) / 2);
  add_text(box, std::max(0.0, (width - of_text) / 2), row_step / 2, text, width_of);
  const double y = row_step + 2;
  add_line(box, {{left, y}, {left + width, y}}, 1.5);
  box.height = y + 1;
  return box;
}

OverlayBox draw_axes(const OverlayFacts& facts, const TextWidth& width_of) {
  constexpr double length = 20, middle = length + 7, head = 2.2, shortest = 0.12;
  constexpr SrgbColor colors[] = {{0xd6, 0x27, 0x28}, {0x2c, 0x9c, 0x2c}, {0x2b, 0x5f, 0xd9}};
  const std::array<std::string, 3> texts{"x", "y", "z"};
  OverlayBox box;
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return facts.axes[a].z < facts.axes[b].z; });
  for (const std::size_t i : order) {  // the farthest first
    const double x = facts.axes[i].x, y = -facts.axes[i].y, size = std::hypot(x, y);
    const Paint paint = paint_of(colors[i]);
    const Point tip{middle + length * x, middle + length * y};
    if (size < shortest) {  // along the view: a dot in the middle
      box.drawing.push_back(
          {.shape = Shape::disc, .points = {{middle, middle}}, .fill = paint, .size = head});
    } else {
      const double u = x / size * head, v = y / size * head;
      add_line(box, {{middle, middle}, {tip.x - u, tip.y - v}}, 1.2, paint);
      box.drawing.push_back({.points = {{tip.x + u, tip.y + v},
                                        {tip.x - u - v, tip.y - v + u},
                                        {tip.x - u + v, tip.y - v - u}},
                             .fill = paint});
    }
    const double width = width_of(texts[i], overlay_text), away = 6.5;
    const double right = size < shortest ? 0.7 : x / size, down = size < shortest ? 0.7 : y / size;
    const Point from = size < shortest ? Point{middle, middle} : tip;
    add_text(box, from.x + away * right - width / 2, from.y + away * down, texts[i], width_of);
  }
  return moved_to_corner(std::move(box), width_of);
}

OverlayBox draw_label(const std::string& text, const TextWidth& width_of) {
  OverlayBox box{.height = overlay_module::capital * overlay_text};
  add_text(box, 0, box.height / 2, text, width_of);
  return box;
}

OverlayBox draw_time(const OverlayFacts& facts, const TextWidth& width_of) {
  OverlayBox box;
  if (facts.time.empty()) return box;
  add_text(box, 0, row_step / 2, facts.time, width_of);
  box.height = row_step;
  return box;
}

}  // namespace boule
