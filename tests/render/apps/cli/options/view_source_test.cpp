// The files that boule view shows, and the options with which render shows the same.
#include "render/apps/cli/commands/view_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule::cli {
namespace {

using testing::HasSubstr;

class ViewSourceTest : public testing::Test {
 protected:
  /// A file of five frames of three particles, far from 0, with a number q that grows.
  std::string trajectory() const {
    std::string text;
    for (int frame = 0; frame < 5; ++frame) {
      text += "3\nProperties=species:S:1:pos:R:3:q:R:1 Time=" + std::to_string(frame) + "\n";
      for (int i = 0; i < 3; ++i) {
        text += "C " + std::to_string(1000000 + 2 * i + frame) + " 0 " + std::to_string(i) + " " +
                std::to_string(10 * frame + i) + "\n";
      }
    }
    return write("run.xyz", text);
  }
  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = (folder_.path() / name).string();
    test::write_bytes(path, text);
    return path;
  }
  static RenderCommand command_for(const std::string& path) {
    RenderCommand command;
    command.scene = path;
    return command;
  }

 private:
  test::TempDir folder_;
};

TEST_F(ViewSourceTest, TrajectoryBeginsWhereRenderDoes) {
  ViewSource source(command_for(trajectory()));
  ASSERT_TRUE(source.open());
  const view::SourceFacts& facts = source.facts();
  EXPECT_EQ(facts.kind, "particles");
  ASSERT_TRUE(facts.frames);
  EXPECT_EQ(facts.frames->last, 4);
  EXPECT_EQ(facts.first_frame, 4);
  EXPECT_FALSE(facts.frames->holds(5));
  const auto last = source.load(facts.look, 4);
  ASSERT_TRUE(last);
  EXPECT_EQ(last.value().particles.front().time, 4);
  EXPECT_EQ(source.options_of(facts.look, 4), " --frame 4");
  // The other frames count from the same point.
  const auto first = source.load(facts.look, 0);
  ASSERT_TRUE(first);
  EXPECT_EQ(first.value().origin.x, last.value().origin.x);
  EXPECT_GT(first.value().origin.x, 0);
  EXPECT_FALSE(source.load(facts.look, 7));
}

TEST_F(ViewSourceTest, ColoursKeepTheirRangeAcrossFrames) {
  ViewSource source(command_for(trajectory()));
  ASSERT_TRUE(source.open());
  const view::ParticleLook look{"q", "magma", {}};
  const auto range_in = [&](const view::ParticleLook& with, int frame) {
    const auto loaded = source.load(with, frame);
    EXPECT_TRUE(loaded);
    return loaded.value().particles.front().colors.scale->range;
  };
  const auto range = range_in(look, 2);
  EXPECT_EQ(range_in(look, 0), range);
  EXPECT_THAT(source.options_of(look, 0),
              HasSubstr(" --frame 0 --color 'q' --map 'magma' --range "));
  // What cannot be read changes nothing; another look has a range of its own.
  EXPECT_FALSE(source.load({"nothing", "", {}}, 0));
  EXPECT_FALSE(source.load({"#12", "", {}}, 0));
  EXPECT_FALSE(source.load({"q", "rainbows", {}}, 0));
  EXPECT_EQ(range_in(look, 1), range);
  const std::array<double, 2> wide{-5, 50};
  EXPECT_EQ(range_in({"q", "magma", wide}, 1), wide);
  EXPECT_EQ(range_in({"q", "viridis", {}}, 0), range);
  EXPECT_NE(range_in({"x", "viridis", {}}, 0), range);
}

TEST_F(ViewSourceTest, ASeriesChoosesOnceFromAllFrames) {
  std::string text;
  for (const std::string side : {"1", "2", "4"}) text += "2\n\nA 0 0 0\nA " + side + " 0 0\n";
  ViewSource source(command_for(write("grow.xyz", text)));
  ASSERT_TRUE(source.open());
  const auto one = source.load({}, 2), other = source.load({}, 0);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one.value().scene.spheres[0].radius, 0.5F);
  EXPECT_EQ(other.value().scene.spheres[0].radius, 0.5F);
  ASSERT_TRUE(one.value().scene.camera && other.value().scene.camera);
  EXPECT_EQ(std::get<PinholeCamera>(*one.value().scene.camera).pose.eye,
            std::get<PinholeCamera>(*other.value().scene.camera).pose.eye);
  EXPECT_EQ(source.options_of({}, 2), " --frame 2 --radius 0.5");
}

TEST_F(ViewSourceTest, GivenOptionsAreInTheCommand) {
  RenderCommand command = command_for(trajectory());
  command.look.given = {{"view", "z"}, {"floor", ""}, {"clip", "x<5"}, {"ghost", "q > 9"}};
  command.look.ghost = "q > 9";
  ViewSource source(command);
  ASSERT_TRUE(source.open());
  EXPECT_EQ(source.facts().shared_options, " --floor --clip 'x<5'");
  EXPECT_THAT(source.options_of(source.facts().look, 0), HasSubstr(" --ghost 'q > 9'"));
  view::ParticleLook look;
  look.ghost = "q < 1";
  look.opacity = 0.5;
  look.outline_by = "kind";
  EXPECT_THAT(source.options_of(look, 0),
              HasSubstr(" --ghost 'q < 1' --opacity 0.5 --outline-by 'kind'"));
  const auto loaded = source.load(look, 0);
  ASSERT_TRUE(loaded);
  EXPECT_FALSE(loaded.value().scene.outline_groups.empty());
  EXPECT_FALSE(loaded.value().scene.image.fog_from);
  look.ghost = "q <";
  EXPECT_FALSE(source.load(look, 0));
  look.ghost.clear();  // its opacity waits for the next ones
  EXPECT_TRUE(source.load(look, 0));
  EXPECT_THAT(source.options_of(look, 0), testing::Not(HasSubstr("--opacity")));
}

TEST_F(ViewSourceTest, ColumnsHaveRanges) {
  ViewSource source(command_for(trajectory()));
  ASSERT_TRUE(source.open());
  ASSERT_TRUE(source.load({}, 1));
  const auto columns = source.columns();
  ASSERT_EQ(columns.size(), 1u);
  EXPECT_EQ(columns[0].name, "q");
  EXPECT_EQ(columns[0].low, 10);
  EXPECT_EQ(columns[0].high, 12);
}

TEST_F(ViewSourceTest, ScenesAreOnePicture) {
  const std::string scene = write("one.toml", "schema = 1\n[[sphere]]\n");
  ViewSource source(command_for(scene));
  ASSERT_TRUE(source.open());
  EXPECT_EQ(source.facts().kind, "toml");
  EXPECT_FALSE(source.facts().frames);
  EXPECT_TRUE(source.load({}, 0));
  EXPECT_TRUE(source.columns().empty());
  EXPECT_EQ(source.options_of({}, 0), "");
}

TEST_F(ViewSourceTest, ASeriesOfScenesHasItsFrames) {
  write("ball.0003.toml", "schema = 1\n[[sphere]]\nradius = 3\n");
  const std::string second = write("ball.0005.toml", "schema = 1\n[[sphere]]\nradius = 5\n");
  RenderCommand command = command_for(second.substr(0, second.size() - 9) + "####.toml");
  command.frames = FrameRange{3, 5, 2};
  ViewSource source(command);
  ASSERT_TRUE(source.open());
  EXPECT_EQ(source.facts().first_frame, 3);
  EXPECT_TRUE(source.facts().frames->holds(5));
  EXPECT_FALSE(source.facts().frames->holds(4));
  EXPECT_EQ(source.load({}, 5).value().scene.spheres[0].radius, 5);
  EXPECT_EQ(source.options_of({}, 5), " --frames 5-5");
}

TEST_F(ViewSourceTest, OptionsOfParticlesAreOfParticlesOnly) {
  RenderCommand command = command_for(write("one.toml", "schema = 1\n[[sphere]]\n"));
  command.look.color = "q";
  command.look.first = "--color";
  ViewSource source(command);
  const auto done = source.open();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().key, "--color");
}

}  // namespace
}  // namespace boule::cli
