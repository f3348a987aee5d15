#include "bench/report/chart_labels.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace boule::bench {
namespace {

constexpr double line_height = label_size + 2;
constexpr double beside = 9;  // from a point's middle to its label

ChartBox box_of(const PlacedLabel& label) {
  const double length = letter_width * static_cast<double>(label.point.text.size());
  const double left = label.anchor[0] == 's' ? label.x : label.x - length;
  return {left, label.y - line_height / 2, left + length, label.y + line_height / 2};
}

/// The nearest free position: rows in turn above and below the point, each side in turn.
std::optional<PlacedLabel> place(const LabelledPoint& point, const std::vector<ChartBox>& taken,
                                 const ChartBox& plot) {
  constexpr int rows = 20;
  constexpr double farther = 14;  // to the side, for each row that does not help
  for (int row = 0; row < rows; ++row) {
    for (const double up : {-1.0, 1.0}) {
      const double y = point.y + up * row * line_height / 2;
      const double aside = beside + (row > 2 ? farther : 0);
      for (const PlacedLabel& label : {PlacedLabel{point, point.x + aside, y, "start"},
                                       PlacedLabel{point, point.x - aside, y, "end"}}) {
        const ChartBox box = box_of(label);
        const auto meets = [&](const ChartBox& other) { return box.meets(other); };
        if (plot.holds(box) && std::none_of(taken.begin(), taken.end(), meets)) return label;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

bool PlacedLabel::is_far() const { return std::fabs(y - point.y) > line_height; }

std::vector<PlacedLabel> place_labels(const std::vector<LabelledPoint>& points,
                                      std::vector<ChartBox> taken, const ChartBox& plot) {
  std::vector<PlacedLabel> labels;
  for (const LabelledPoint& point : points) {
    if (point.text.empty()) continue;
    const auto label = place(point, taken, plot);
    if (!label) continue;
    taken.push_back(box_of(*label));
    labels.push_back(*label);
  }
  return labels;
}

}  // namespace boule::bench
