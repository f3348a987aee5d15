// Charts for any viewer: the colours stand in attributes, as librsvg and PDF want them.
#include "bench/report/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "bench/report/chart_labels.h"
#include "tests/support/file_bytes.h"

namespace boule::bench {
namespace {

using testing::HasSubstr;
using testing::Not;

/// All tags of a name, attributes included.
std::vector<std::string> tags(const std::string& svg, const std::string& name) {
  const std::regex tag("<" + name + "[ >][^>]*>?");
  return {std::sregex_token_iterator(svg.begin(), svg.end(), tag), std::sregex_token_iterator()};
}

/// Checks that every shape has a colour of its own: without style sheets it would be black.
void expect_colors_without_css(const std::string& svg) {
  EXPECT_THAT(svg, Not(HasSubstr("var(")));
  ASSERT_EQ(tags(svg, "svg").size(), 1U);
  EXPECT_THAT(tags(svg, "svg")[0], HasSubstr(" fill=\"#"));  // the texts'
  EXPECT_THAT(tags(svg, "svg")[0], HasSubstr(" font-size="));
  std::size_t shapes = 0;
  for (const char* name : {"circle", "rect", "path"}) {
    for (const std::string& tag : tags(svg, name)) {
      const bool line = tag.find("class=\"grid\"") != std::string::npos ||
                        tag.find("class=\"leader\"") != std::string::npos ||
                        tag.find("class=\"line ") != std::string::npos;
      EXPECT_THAT(tag, HasSubstr(line ? " stroke=\"#" : " fill=\"#"));
      ++shapes;
    }
  }
  EXPECT_GT(shapes, 5U);
}

Chart example() {
  Chart chart{"A & B", {"x", true}, {"y", false}, {}, {}};
  for (int color = 0; color < 10; ++color) {
    const std::string name = "series " + std::to_string(color);
    const Look look{color, color % 5};
    const double x = color == 0 ? 0 : 100 + color, y = 50 + color % 2;
    chart.series.push_back({name, look, color > 4, {{x, y, "tip", name}, {x * 2, y, "", ""}}});
    chart.legend.push_back({name, look});
  }
  chart.legend.push_back({"not in the chart", {6, 2}});
  return chart;
}

TEST(Chart, HasItsColorsInAttributes) {
  expect_colors_without_css(draw_alone(example()));
  expect_colors_without_css(draw(example()));
  expect_colors_without_css(draw(
      HeatMap{"map", "x", "y", {"a", "b", "c"}, {"d", "e"}, {0, 0.5, 1, 0, 0, 0.1}, {6, "tip"}}));
}

TEST(Chart, AloneNamesEachThingOnce) {
  const std::string svg = draw_alone(example());
  for (const LegendEntry& entry : example().legend) {
    const std::string name = ">" + entry.name + "<";
    EXPECT_THAT(svg, HasSubstr(name));
    EXPECT_EQ(svg.find(name), svg.rfind(name)) << name;
  }
}

TEST(Chart, ShippedChartsKeepColorsInAttributes) {
  std::size_t charts = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BOULE_REPORT)) {
    if (entry.path().extension() != ".svg") continue;
    SCOPED_TRACE(entry.path());
    expect_colors_without_css(test::read_bytes(entry.path()));
    ++charts;
  }
  EXPECT_EQ(charts, 2U);
}

TEST(ChartLabels, MeetNeitherEachOtherNorAMarker) {
  const ChartBox plot{0, 0, 500, 300};
  std::vector<LabelledPoint> points;
  std::vector<ChartBox> markers;
  for (int i = 0; i < 9; ++i) {
    const double x = i < 8 ? 480 + i : 5, y = 100 + 3 * i;
    points.push_back({x, y, "some name " + std::to_string(i)});
    markers.push_back({x - 6, y - 6, x + 6, y + 6});
  }
  points.push_back({100, 100, ""});
  const std::vector<PlacedLabel> labels = place_labels(points, markers, plot);
  ASSERT_EQ(labels.size(), 9U);
  std::vector<ChartBox> taken = markers;
  for (const PlacedLabel& label : labels) {
    const double length = letter_width * static_cast<double>(label.point.text.size());
    const double left = std::string(label.anchor) == "start" ? label.x : label.x - length;
    const ChartBox box{left, label.y - label_size / 2, left + length, label.y + label_size / 2};
    EXPECT_TRUE(plot.holds(box)) << label.point.text;
    for (const ChartBox& other : taken) EXPECT_FALSE(box.meets(other)) << label.point.text;
    taken.push_back(box);
  }
  EXPECT_STREQ(labels.back().anchor, "start");  // alone: right beside its point
  EXPECT_FALSE(labels.back().is_far());
}

TEST(ChartLabels, WithoutRoomAreLeftOut) {
  EXPECT_TRUE(place_labels({{5, 5, "longer than its plot"}}, {}, {0, 0, 20, 20}).empty());
}

}  // namespace
}  // namespace boule::bench
