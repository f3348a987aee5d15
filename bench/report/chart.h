#pragma once

#include <string>
#include <vector>

namespace boule::bench {

struct Axis {
  std::string label;         ///< with its unit
  bool logarithmic = false;  ///< with a place of its own for 0, before the first decade
};

struct ChartPoint {
  double x, y;
  std::string tip;  ///< shown where one points at it
};

/// How points look: one of 10 colours, which the colour-blind can tell apart as well (Okabe and Ito
/// 2008; 8 is the text's), one of 5 shapes.
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

/// A whole <svg>, its colours left to chart_style(), its legend to draw_legend(). Points that are
/// not finite are left out, and on logarithmic axes those below 0.
std::string draw(const Chart& chart);

/// HTML that wraps as the page does.
std::string draw_legend(const Chart& chart);

/// Both as one SVG file.
std::string draw_alone(const Chart& chart);

/// Values from 0 to 1 in columns and rows, dark where large.
struct HeatMap {
  std::string title, x_label, y_label;
  std::vector<std::string> columns, rows;  ///< their names; rows from below
  std::vector<double> values;              ///< row by row
  std::vector<std::string> tips;           ///< of each value
};
std::string draw(const HeatMap& map);

/// The colours of both, light and dark, as a style sheet.
std::string chart_style();

/// Text as it may stand in HTML, attributes included.
std::string escaped(const std::string& text);

}  // namespace boule::bench
