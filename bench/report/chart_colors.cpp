#include "bench/report/chart_colors.h"

#include <fmt/format.h>

namespace boule::bench {
namespace {

/// Rules that replace the colours of the drawing.
std::string rules(const ChartColors& colors) {
  std::string css = fmt::format(
      ".chart text {{ fill: {0}; }}\n"
      ".chart .page {{ fill: {2}; }} .chart .m {{ stroke: {2}; }}\n"
      ".chart .grid, .chart .leader {{ stroke: {1}; }}\n"
      ".chart .cell {{ fill: {4}; }} .chart .some {{ fill: {3}; }}\n",
      colors.ink, colors.faint, colors.page, colors.hot, colors.cold);
  for (std::size_t i = 0; i < colors.series.size(); ++i) {
    css += fmt::format(".chart .m.c{0} {{ fill: {1}; }} .chart .line.c{0} {{ stroke: {1}; }}\n", i,
                       colors.series[i]);
  }
  return css;
}

}  // namespace

std::string chart_style() {
  const auto pointed_at = [](const ChartColors& colors) {
    return fmt::format(
        ".chart .m[data-tip]:hover, .chart .m:focus, .chart .cell:hover, .chart .cell:focus "
        "{{ stroke: {}; stroke-width: 2; outline: none; }}\n",
        colors.ink);
  };
  return "\n" + pointed_at(light_colors) + "@media (prefers-color-scheme: dark) {\n" +
         rules(dark_colors) + pointed_at(dark_colors) + "}\n";
}

}  // namespace boule::bench
