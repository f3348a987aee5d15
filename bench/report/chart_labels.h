#pragma once

#include <string>
#include <vector>

namespace boule::bench {

/// A rectangle of a drawing, y downward.
struct ChartBox {
  double left, top, right, bottom;

  [[nodiscard]] bool meets(const ChartBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  [[nodiscard]] bool holds(const ChartBox& other) const {
    return left <= other.left && top <= other.top && right >= other.right && bottom >= other.bottom;
  }
};

/// A point that gets a label.
struct LabelledPoint {
  double x, y;
  std::string text;
};

/// Where a label stands: its anchor ("start" or "end") at (x, y), the base line's middle.
struct PlacedLabel {
  LabelledPoint point;
  double x, y;
  const char* anchor;

  /// Whether it is so far from its point that a line should lead there.
  [[nodiscard]] bool is_far() const;
};

/// Height of a label's letters, and the mean width of one.
inline constexpr double label_size = 11, letter_width = 6;

/// Puts each label, in order, to the right or left of its point, as near as possible without
/// overlapping a rectangle of `taken`, another label or the border of `plot`. A label for which
/// there is no room is left out.
std::vector<PlacedLabel> place_labels(const std::vector<LabelledPoint>& points,
                                      std::vector<ChartBox> taken, const ChartBox& plot);

}  // namespace boule::bench
