#include "bench/report/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/report/chart_colors.h"
#include "bench/report/chart_labels.h"

namespace boule::bench {
namespace {

// Sizes in the drawing's own pixels; the page scales it.
constexpr double width = 720, height = 430;
constexpr double left = 92, right = 16, top = 34, bottom = 68;
constexpr double legend_line = 20;

constexpr const ChartColors& colors = light_colors;

const char* color_of(const Look& look) {
  return colors.series[static_cast<std::size_t>(look.color) % colors.series.size()];
}

/// Maps values to positions along one axis.
class Scale {
 public:
  Scale(const Axis& axis, double begin, double end) : axis_(axis), begin_(begin), end_(end) {}

  void include(double value) {
    if (!std::isfinite(value) || (axis_.logarithmic && value < 0)) return;
    if (axis_.logarithmic && value == 0) {
      zero_ = true;
      return;
    }
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  /// Rounds the range to whole ticks.
  void finish() {
    if (low_ > high_) low_ = high_ = 1;
    if (axis_.logarithmic) {
      low_ = std::floor(std::log10(low_));
      high_ = std::max(std::ceil(std::log10(high_)), low_ + 1);
      if (zero_) low_ -= 1;
      return;
    }
    low_ = std::min(low_, 0.0);
    step_ = nice_step((high_ - low_) / 6);
    high_ = std::max(std::ceil(high_ / step_), 1.0) * step_;
  }

  [[nodiscard]] bool shows(double value) const {
    return std::isfinite(value) && !(axis_.logarithmic && value < 0);
  }
  [[nodiscard]] double place(double value) const {
    if (axis_.logarithmic) value = value == 0 ? low_ : std::log10(value);
    return begin_ + (value - low_) / (high_ - low_) * (end_ - begin_);
  }

  struct Tick {
    double place;
    std::string label;
  };
  [[nodiscard]] std::vector<Tick> ticks() const {
    std::vector<Tick> all;
    const double step = axis_.logarithmic ? std::ceil((high_ - low_) / 9) : step_;
    for (double at = low_; at <= high_ + step / 2; at += step) {
      const bool zero = axis_.logarithmic && zero_ && at == low_;
      const double value = axis_.logarithmic ? std::pow(10, at) : at;
      all.push_back(
          {begin_ + (at - low_) / (high_ - low_) * (end_ - begin_), zero ? "0" : label(value)});
    }
    return all;
  }

 private:
  static double nice_step(double least) {
    const double power = std::pow(10, std::floor(std::log10(std::max(least, 1e-300))));
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (least <= factor * power) return factor * power;
    }
    return 10 * power;
  }
  static std::string label(double value) {
    const double size = std::fabs(value);
    if (size != 0 && (size >= 1e5 || size < 1e-3)) {
      const int power = static_cast<int>(std::lround(std::log10(size)));
      return fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>", power);
    }
    return fmt::format("{:.6g}", value);
  }

  Axis axis_;
  double begin_, end_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_, step_ = 1;
  bool zero_ = false;
};

std::string marker(double x, double y, const Look& look, const std::string& tip) {
  const std::string attributes = fmt::format(
      "class=\"m c{}\" fill=\"{}\" stroke=\"{}\"{}", look.color % 10, color_of(look), colors.page,
      tip.empty() ? "" : fmt::format(" tabindex=\"0\" data-tip=\"{}\"", escaped(tip)));
  switch (look.shape % 5) {
    case 0:
      return fmt::format("<circle {} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>", attributes, x, y);
    case 1:
      return fmt::format("<rect {} x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"9\"/>",
                         attributes, x - 4.5, y - 4.5);
    case 2:
      return fmt::format("<path {} d=\"M{:.1f} {:.1f}l5.5 9.5h-11z\"/>", attributes, x, y - 6);
    case 3:
      return fmt::format("<path {} d=\"M{:.1f} {:.1f}l6 6l-6 6l-6 -6z\"/>", attributes, x, y - 6);
    default:
      return fmt::format("<path {} d=\"M{:.1f} {:.1f}l5.5 -9.5h-11z\"/>", attributes, x, y + 6);
  }
}

std::string text(double x, double y, const char* anchor, const std::string& content,
                 const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor,
                     more, content);
}

/// `background`: what is drawn first.
std::string open_svg(const std::string& title, double full_height,
                     const std::string& background = "") {
  return fmt::format(
             "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
             "role=\"img\" aria-label=\"{}\" fill=\"{}\" font-size=\"12\" "
             "font-family=\"system-ui, sans-serif\">\n",
             width, full_height, escaped(title), colors.ink) +
         background +
         text(left, 18, "start", escaped(title),
              " class=\"title\" font-weight=\"600\" font-size=\"14\"") +
         "\n";
}

std::string axis_labels(const std::string& x, const std::string& y) {
  const double middle = (top + height - bottom) / 2;
  return text((left + width - right) / 2, height - 14, "middle", escaped(x)) +
         text(18, middle, "middle", escaped(y),
              fmt::format(" transform=\"rotate(-90 18 {})\"", middle));
}

std::string grid_line(const std::string& path) {
  return fmt::format("<path class=\"grid\" stroke=\"{}\" d=\"{}\"/>", colors.faint, path);
}

std::string grid(const Scale& x, const Scale& y) {
  std::string svg;
  for (const auto& [at, label] : x.ticks()) {
    svg += grid_line(fmt::format("M{:.1f} {}V{}", at, top, height - bottom));
    const double end = width - right;
    const bool is_last = std::abs(at - end) < 1;  // on a phone half of it would be cut
    svg += text(is_last ? width - 4 : at, height - bottom + 28, is_last ? "end" : "middle", label);
  }
  for (const auto& [at, label] : y.ticks()) {
    svg += grid_line(fmt::format("M{} {:.1f}H{}", left, at, width - right));
    svg += text(left - 8, at + 4, "end", label);
  }
  return svg + "\n";
}

std::string draw_series(const Series& series, const Scale& x, const Scale& y) {
  std::string line, markers;
  for (const ChartPoint& point : series.points) {
    if (!x.shows(point.x) || !y.shows(point.y)) continue;
    const double px = x.place(point.x), py = y.place(point.y);
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", px, py);
    markers += marker(px, py, series.look, point.tip);
  }
  if (!series.line) return markers + "\n";
  return fmt::format(
             "<path class=\"line c{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" "
             "d=\"{}\"/>",
             series.look.color % 10, color_of(series.look), line) +
         markers + "\n";
}

/// The contents of an <svg>, and the labels that it shows.
struct Drawing {
  std::string svg;
  std::vector<std::string> labels;
};

/// The labels of all points, beside them; a line leads to those that had to go farther.
void draw_labels(const Chart& chart, const Scale& x, const Scale& y, Drawing& drawing) {
  std::vector<LabelledPoint> points;
  std::vector<ChartBox> taken;
  for (const Series& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      if (!x.shows(point.x) || !y.shows(point.y)) continue;
      const double px = x.place(point.x), py = y.place(point.y);
      taken.push_back({px - 6, py - 6, px + 6, py + 6});
      points.push_back({px, py, point.label});
    }
  }
  for (const PlacedLabel& label :
       place_labels(points, taken, {left, top, width - right, height - bottom})) {
    if (label.is_far()) {
      drawing.svg += fmt::format(
          "<path class=\"leader\" fill=\"none\" stroke=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>",
          colors.faint, label.point.x, label.point.y, label.x, label.y);
    }
    drawing.svg += text(label.x, label.y + 4, label.anchor, escaped(label.point.text),
                        fmt::format(" class=\"label\" font-size=\"{}\"", label_size));
    drawing.labels.push_back(label.point.text);
  }
}

/// The series that no label in the chart names.
std::vector<LegendEntry> not_labelled(const std::vector<LegendEntry>& legend,
                                      const std::vector<std::string>& labels) {
  std::vector<LegendEntry> rest;
  for (const LegendEntry& entry : legend) {
    if (std::find(labels.begin(), labels.end(), entry.name) == labels.end()) rest.push_back(entry);
  }
  return rest;
}

/// The number of legend entries in a row, by the width of the longest.
std::size_t legend_columns(const std::vector<LegendEntry>& entries) {
  std::size_t longest = 0;
  for (const LegendEntry& entry : entries) longest = std::max(longest, entry.name.size());
  return longest <= 18 ? 4 : 3;
}

/// Draws the legend below the axes.
std::string legend_lines(const std::vector<LegendEntry>& entries) {
  std::string svg;
  const std::size_t columns = legend_columns(entries);
  const double column = (width - left) / static_cast<double>(columns);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t row = i / columns;
    const double x = left + column * static_cast<double>(i % columns);
    const double y = height + 8 + legend_line * static_cast<double>(row);
    svg +=
        marker(x, y, entries[i].look, "") + text(x + 12, y + 4, "start", escaped(entries[i].name));
  }
  return svg;
}

Drawing draw_points(const Chart& chart) {
  Scale x(chart.x, left, width - right), y(chart.y, height - bottom, top);
  for (const Series& series : chart.series) {
    for (const ChartPoint& point : series.points) {
      x.include(point.x);
      y.include(point.y);
    }
  }
  x.finish();
  y.finish();
  Drawing drawing{axis_labels(chart.x.label, chart.y.label) + grid(x, y), {}};
  for (const Series& series : chart.series) drawing.svg += draw_series(series, x, y);
  draw_labels(chart, x, y, drawing);
  return drawing;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string draw(const Chart& chart) {
  return open_svg(chart.title, height) + draw_points(chart).svg + "\n</svg>\n";
}

std::string draw_legend(const Chart& chart) {
  std::string html = "<p class=\"legend\">";
  for (const auto& [name, look] : chart.legend) {
    html += "<span><svg class=\"chart key\" viewBox=\"-8 -8 16 16\">" + marker(0, 0, look, "") +
            "</svg>" + escaped(name) + "</span>\n";
  }
  return html + "</p>\n";
}

std::string draw_alone(const Chart& chart) {
  const Drawing drawing = draw_points(chart);
  const std::vector<LegendEntry> legend = not_labelled(chart.legend, drawing.labels);
  const double columns = static_cast<double>(legend_columns(legend));
  const double rows = std::ceil(static_cast<double>(legend.size()) / columns);
  const double full_height = height + legend_line * rows;
  const std::string background =
      fmt::format("<rect class=\"page\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", width,
                  full_height, colors.page);
  return open_svg(chart.title, full_height, background) + "<style>" + chart_style() + "</style>\n" +
         drawing.svg + "\n" + legend_lines(legend) + "</svg>\n";
}

std::string draw(const HeatMap& map) {
  const double cell_x = (width - left - right) / static_cast<double>(map.columns.size());
  const double cell_y = (height - top - bottom) / static_cast<double>(map.rows.size());
  std::string svg = open_svg(map.title, height) + axis_labels(map.x_label, map.y_label);
  for (std::size_t row = 0; row < map.rows.size(); ++row) {
    const double y = height - bottom - cell_y * static_cast<double>(row + 1);
    svg += text(left - 8, y + cell_y / 2 + 4, "end", escaped(map.rows[row]));
    for (std::size_t column = 0; column < map.columns.size(); ++column) {
      const std::size_t at = row * map.columns.size() + column;
      const bool some = map.values[at] > 0;
      svg += fmt::format(
          "<rect class=\"{}\" fill=\"{}\" fill-opacity=\"{:.3f}\" tabindex=\"0\" x=\"{:.1f}\" "
          "y=\"{:.1f}\" "
          "width=\"{:.1f}\" height=\"{:.1f}\" data-tip=\"{}\"/>",
          some ? "cell some" : "cell", some ? colors.hot : colors.cold,
          some ? 0.15 + 0.85 * map.values[at] : 1.0, left + cell_x * static_cast<double>(column), y,
          cell_x - 1, cell_y - 1, escaped(map.tips[at]));
    }
    svg += "\n";
  }
  for (std::size_t column = 0; column < map.columns.size(); ++column)
    svg += text(left + cell_x * (static_cast<double>(column) + 0.5), height - bottom + 28, "middle",
                escaped(map.columns[column]));
  return svg + "\n</svg>\n";
}

}  // namespace boule::bench
