// Sizes of pictures, in pixels and in print.
#include "render/apps/job/render_job.h"

#include <gtest/gtest.h>

#include "render/apps/job/options/option_values.h"
#include "render/apps/job/picture/picture_header.h"

namespace boule {
namespace {

Scene scene_with(float outline) {
  Scene scene;
  scene.image.width = 1200;
  scene.image.height = 900;
  scene.image.outline = outline;
  return scene;
}

TEST(RenderJob, WidthInPrintMakesPixels) {
  RenderJob job;
  job.width = parse_length("85mm");
  RenderOptions options = options_of(job, scene_with(0));
  EXPECT_EQ(options.width, 1004);  // 300 pixels per inch
  EXPECT_EQ(options.height, 753);
  job.dpi = 600;
  job.size = Size{2, 1};
  options = options_of(job, scene_with(0));
  EXPECT_EQ(options.width, 2008);
  EXPECT_EQ(options.height, 1004);
}

TEST(RenderJob, LengthsHaveUnits) {
  EXPECT_EQ(parse_length("85mm"), 85);
  EXPECT_EQ(parse_length("8.5cm"), 85);
  EXPECT_EQ(parse_length("2in"), 50.8);
  EXPECT_EQ(parse_length("72pt"), 25.4);
  for (const char* text : {"", "85", "mm", "0mm", "-1mm", "1e3mm", "200m", "85 mm", "101000mm"})
    EXPECT_FALSE(parse_length(text)) << text;
}

TEST(RenderJob, OutlinesMayBeInPoints) {
  RenderJob job;
  EXPECT_EQ(options_of(job, scene_with(1)).outline, 1);
  job.outline = parse_outline("0.6pt");
  job.dpi = 600;
  EXPECT_FLOAT_EQ(options_of(job, scene_with(1)).outline, 5);
  job.outline = parse_outline("2.5");
  EXPECT_EQ(options_of(job, scene_with(1)).outline, 2.5F);
  EXPECT_FALSE(parse_outline("pt"));
  EXPECT_FALSE(parse_outline("-1"));
}

// The scene's lines would be too fine to be printed; a scene without lines has none in print.
TEST(RenderJob, PrintedOutlinesAreWideEnough) {
  RenderJob job;
  job.dpi = 600;
  EXPECT_FLOAT_EQ(options_of(job, scene_with(1)).outline, 0.35F / 72 * 600);
  EXPECT_EQ(options_of(job, scene_with(9)).outline, 9);
  EXPECT_EQ(options_of(job, scene_with(0)).outline, 0);
}

TEST(RenderJob, HeadersTellTheResolution) {
  EXPECT_TRUE(resolution_header({}).empty());
  EXPECT_TRUE(resolution_header({Size{4, 3}, {}, {}}).empty());
  const Metadata header = resolution_header({{}, 85.0, {}});
  ASSERT_EQ(header.size(), 3U);
  EXPECT_EQ(header[0], (Metadata::value_type{"XResolution", 300.0F}));
  EXPECT_EQ(header[1], (Metadata::value_type{"YResolution", 300.0F}));
  EXPECT_EQ(header[2], (Metadata::value_type{"ResolutionUnit", std::string("in")}));
}

}  // namespace
}  // namespace boule
