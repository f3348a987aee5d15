// What is drawn on pictures, without what draws it.
#include "render/apps/job/overlay/overlay.h"
#include "render/apps/job/picture/legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "render/apps/job/overlay/overlay_layout.h"
#include "render/apps/job/overlay/svg_page.h"

namespace boule {
namespace {

using overlay_module::Shape;
using testing::ElementsAre;
using testing::HasSubstr;

/// Letters of one width.
double fixed_width(const std::string& text, double size) {
  return 0.5 * size * static_cast<double>(text.size());
}

OverlayFacts facts_of(const OverlayParts& parts, double pixels_per_point) {
  OverlayFacts facts;
  facts.parts = parts;
  facts.colors.emplace_back();
  facts.colors[0].species = {{"Na", {170, 90, 240}, 4}, {"Cl", {30, 240, 30}, 4}};
  facts.axes = {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
  facts.pixels_per_length = 10 * pixels_per_point;  // a length of 1 is 10 points
  facts.unit = "\u00c5";
  facts.time = "t = 2.5";
  facts.pixels_per_point = pixels_per_point;
  return facts;
}

const OverlayParts all_parts{OverlayPart::legend, OverlayPart::scale, OverlayPart::axes,
                             OverlayPart::time};

/// On a ground of one grey.
Drawing drawn(const OverlayFacts& facts, int width, int height, std::uint8_t grey) {
  const std::vector<std::uint8_t> codes(
      3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey);
  return lay_out(facts, {width, height, 3, codes}, fixed_width);
}

const DrawnItem& text_item(const Drawing& drawing, const std::string& text) {
  for (const DrawnItem& one : drawing) {
    if (one.shape == Shape::text && one.text == text) return one;
  }
  ADD_FAILURE() << text;
  return drawing.front();
}

TEST(Overlay, NamesAreUnderstood) {
  EXPECT_THAT(*parse_overlay("scale,legend"), ElementsAre(OverlayPart::scale, OverlayPart::legend));
  for (const char* wrong : {"", "lgend", "scale,scale", "scale,", "Scale"})
    EXPECT_FALSE(parse_overlay(wrong)) << wrong;
  EXPECT_EQ(hint_overlay("scale,lgend"), "; did you mean 'legend'?");
  EXPECT_EQ(hint_overlay("thermometer"), "");
}

TEST(Overlay, LengthsAreRound) {
  for (const auto& [length, round] :
       {std::pair{1.0, 1.0}, {1.99, 1.0}, {4.9, 2.0}, {7.0, 5.0}, {99.0, 50.0}, {0.03, 0.02}})
    EXPECT_DOUBLE_EQ(round_length(length), round);
}

TEST(Overlay, HasOneSizeAtAnyResolution) {
  const Drawing coarse = drawn(facts_of(all_parts, 1), 288, 216, 255);
  const Drawing fine = drawn(facts_of(all_parts, 4), 4 * 288, 4 * 216, 255);
  ASSERT_EQ(coarse.size(), fine.size());
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    EXPECT_EQ(coarse[i].text, fine[i].text);
    EXPECT_EQ(coarse[i].size, fine[i].size);
    ASSERT_EQ(coarse[i].points.size(), fine[i].points.size());
    for (std::size_t k = 0; k < coarse[i].points.size(); ++k) {
      EXPECT_DOUBLE_EQ(coarse[i].points[k].x, fine[i].points[k].x);
      EXPECT_DOUBLE_EQ(coarse[i].points[k].y, fine[i].points[k].y);
    }
  }
  EXPECT_EQ(text_item(coarse, "Na").size, overlay_text);
}

TEST(Overlay, PartsAreInTheirCorners) {
  const Drawing drawing = drawn(facts_of(all_parts, 1), 288, 216, 255);
  const auto at = [&](const char* text) { return text_item(drawing, text).points[0]; };
  EXPECT_GT(at("Cl").x, 250);
  EXPECT_LT(at("Cl").y, 40);
  EXPECT_LT(at("t = 2.5").x, 10);
  EXPECT_LT(at("t = 2.5").y, 20);
  EXPECT_LT(at("y").x, 40);
  EXPECT_GT(at("y").y, 160);
  EXPECT_GT(at("5 \u00c5").x, 200);
  EXPECT_GT(at("5 \u00c5").y, 190);
}

TEST(Overlay, BarIsRightOnSmallPictures) {
  for (const auto& [side, text] : {std::pair{288, "5 \u00c5"}, {80, "2 \u00c5"}}) {
    const Drawing drawing = drawn(facts_of({OverlayPart::scale}, 1), side, side, 255);
    text_item(drawing, text);
    const auto& points = drawing.back().points;
    EXPECT_NEAR(points[1].x - points[0].x, side == 288 ? 50 : 20, 1e-9);  // rounded sums
  }
}

TEST(Overlay, TextDiffersFromTheGround) {
  const Drawing light = drawn(facts_of(all_parts, 1), 288, 216, 250);
  const Drawing dark = drawn(facts_of(all_parts, 1), 288, 216, 20);
  EXPECT_LT(text_item(light, "Na").fill.r, 0.2);
  EXPECT_GT(text_item(dark, "Na").fill.r, 0.8);
  EXPECT_EQ(text_item(dark, "Na").halo.a, 0);
  std::vector<std::uint8_t> codes(3 * 288 * 216, 255);
  for (std::size_t i = 0; i < codes.size(); i += 12) codes[i] = codes[i + 1] = codes[i + 2] = 0;
  const Drawing mixed = lay_out(facts_of(all_parts, 1), {288, 216, 3, codes}, fixed_width);
  EXPECT_GT(text_item(mixed, "Na").halo.r, 0.9);
}

TEST(Overlay, BarMarksWhatLiesBeyond) {
  OverlayFacts facts;
  facts.parts = {OverlayPart::legend};
  facts.colors.emplace_back();
  facts.colors[0].scale = ParticleColors::Scale{"q", ColorMap({{255, 0, 0}, {0, 0, 255}}), {0, 10}};
  const auto corners = [&] {
    std::size_t triangles = 0;
    for (const DrawnItem& one : draw_legend(facts, 150, fixed_width).drawing)
      triangles += one.shape == Shape::path && one.points.size() == 3 ? 1 : 0;
    return triangles;
  };
  EXPECT_EQ(corners(), 0U);
  facts.colors[0].scale->goes_above = true;
  EXPECT_EQ(corners(), 1U);
  facts.colors[0].scale->goes_below = true;
  EXPECT_EQ(corners(), 2U);
}

TEST(Overlay, BarNamesItsUnit) {
  ParticleColors::Scale scale{"bfactor", ColorMap({{255, 0, 0}, {0, 0, 255}}), {0, 10}};
  EXPECT_EQ(legend_title(scale), "bfactor");
  scale.unit = column_unit("pdb", "bfactor");
  EXPECT_EQ(legend_title(scale), "bfactor (\u00c5\u00b2)");
  EXPECT_EQ(column_unit("gro", "|v|"), "nm/ps");
  EXPECT_EQ(column_unit("pqr", "charge"), "e");
  EXPECT_EQ(column_unit("dump", "x"), "");
}

TEST(Overlay, LegendHasRoom) {
  OverlayFacts facts = facts_of({OverlayPart::legend}, 1);
  // Two letters, a dot, the edge and what is between: 10 + 10 + 7 + 8 points of 288, less the
  // margin.
  EXPECT_NEAR(legend_room(facts, 288, 216, 0.05), 35.0 / 288 - 0.05, 0.01);
  facts.colors[0].species[0].name = std::string(80, 'x');
  EXPECT_EQ(legend_room(facts, 288, 216, 0.05), 0.4);
  facts.colors.clear();
  EXPECT_EQ(legend_room(facts, 288, 216, 0.05), 0);
  EXPECT_EQ(legend_room(facts_of({OverlayPart::scale}, 1), 288, 216, 0.05), 0);
}

TEST(Overlay, LabelsStandOnOrBesideParticles) {
  OverlayFacts facts;
  facts.pixels_per_point = 2;
  facts.labels = {
      {200, 100, 40, 1, 1, "ALA"}, {100, 300, 2, 2, 1, "GLY"}, {104, 304, 2, 3, 1, "VAL"}};
  const Drawing drawing = drawn(facts, 576, 432, 255);
  ASSERT_EQ(drawing.size(), 2U);  // the farthest would cover another one
  EXPECT_EQ(text_item(drawing, "ALA").points[0].x, 100 - fixed_width("ALA", overlay_text) / 2);
  EXPECT_DOUBLE_EQ(text_item(drawing, "ALA").points[0].y, 50);
  EXPECT_GT(text_item(drawing, "GLY").points[0].x, 51);
  EXPECT_LT(text_item(drawing, "GLY").points[0].y, 149);
}

TEST(Overlay, TextsAreUtf8) {
  EXPECT_EQ(drawable("\u00c5 \xff\x01\xc3"), "\u00c5 ???");
  EXPECT_EQ(drawable("\xed\xa0\x80"), "???");
  EXPECT_EQ(xml_text("a<b>&"), "a&lt;b&gt;&amp;");
}

TEST(Overlay, SvgHasTextAndThePicture) {
  const Drawing drawing = drawn(facts_of(all_parts, 1), 288, 216, 255);
  const auto svg = svg_page(drawing, Image(288, 216), 1, {});
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_THAT(svg.value(), HasSubstr("width=\"288.000pt\" height=\"216.000pt\""));
  EXPECT_THAT(svg.value(), HasSubstr("href=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(svg.value(), HasSubstr(">Na</text>"));
}

}  // namespace
}  // namespace boule
