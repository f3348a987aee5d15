#pragma once

#include <array>
#include <string>

namespace boule::bench {

/// The colours of charts on a light or a dark page, as SVG writes them. `series`: ten that the
/// colour-blind can tell apart as well (Okabe and Ito 2008); number 8 is the text's.
struct ChartColors {
  const char *ink, *faint, *page;  ///< of texts, of grid and leading lines, behind everything
  const char *hot, *cold;          ///< of cells of a heat map, with and without something in them
  std::array<const char*, 10> series;
};
inline constexpr ChartColors light_colors{"#222222",
                                          "#d8d8d8",
                                          "#ffffff",
                                          "#d55e00",
                                          "#eef1f4",
                                          {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                           "#56b4e9", "#6b6b6b", "#9a8a00", "#222222", "#8b4a1c"}};
inline constexpr ChartColors dark_colors{"#e6e6e6",
                                         "#3c4043",
                                         "#15181b",
                                         "#d55e00",
                                         "#23282d",
                                         {"#4aa8e0", "#f07b2c", "#2bc79a", "#cc79a7", "#e69f00",
                                          "#56b4e9", "#a8a8a8", "#d8cc3a", "#e6e6e6", "#c98c5a"}};

/// A style sheet: the dark colours, where the reader prefers them, and what is pointed at. All else
/// stands in attributes of the drawing, in light colours, for viewers that know little of CSS.
std::string chart_style();

}  // namespace boule::bench
