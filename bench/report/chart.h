#pragma once

#include <string>
#include <vector>

namespace boule::bench {

struct Axis {
  std::string label;         ///< with its unit
  bool logarithmic = false;  ///< 0 has a position of its own, before the first decade
};

struct ChartPoint {
  double x, y;
  std::string tip;         ///< shown where one points at it
  std::string label = {};  ///< written beside it; none: the empty one
};

/// How points look: one of 10 colours (chart_colors.h), one of 5 shapes.
struct Look {
  int color = 0, shape = 0;
};

struct Series {
  std::string name;
  Look look;
  bool line = false;  ///< joins its points
  std::vector<ChartPoint> points;
};

struct LegendEntry {
  std::string name;
  Look look;
};

/// Points over two axes.
struct Chart {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  std::vector<LegendEntry> legend;
};

/// A whole <svg> in light colours (chart_style() has the dark ones), its legend left to
/// draw_legend(). Points that are not finite are left out, and on logarithmic axes those below 0.
std::string draw(const Chart& chart);

/// HTML that wraps as the page does.
std::string draw_legend(const Chart& chart);

/// Both as one SVG file; the legend leaves out what labels beside the points name.
std::string draw_alone(const Chart& chart);

/// Values from 0 to 1 in columns and rows, dark where large.
struct HeatMap {
  std::string title, x_label, y_label;
  std::vector<std::string> columns, rows;  ///< their names; rows from below
  std::vector<double> values;              ///< row by row
  std::vector<std::string> tips;           ///< of each value
};
std::string draw(const HeatMap& map);

/// Text as it may stand in HTML, attributes included.
std::string escaped(const std::string& text);

}  // namespace boule::bench
