// Series of particle files without a scene.
#include <filesystem>

#include "tests/render/apps/cli/particles/particles_fixture.h"

namespace boule::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

using ParticleSeries = ParticlesTest;

TEST_F(ParticleSeries, HaveOneCamera) {
  const std::string file = growing(3);
  const std::vector<std::string> view = {"--quick", "--view", "-z", "--up", "y"};
  const ProgramRun run =
      render(file, "f#.ppm", {"--quick", "--view", "-z", "--up", "y", "--frames", "0-2"});
  const std::string note = "the camera is fitted to all 3 frames";
  EXPECT_THAT(run.err, HasSubstr(note));
  EXPECT_EQ(run.err.find(note), run.err.rfind(note));
  // The last frame is the largest: alone it has the same camera, and the others have not.
  for (const char* number : {"0", "1", "2"}) {
    std::vector<std::string> alone = view;
    alone.insert(alone.end(), {"--frame", number});
    render(file, "alone.ppm", alone);
    EXPECT_EQ(read("alone.ppm") == read("f" + std::string(number) + ".ppm"),
              std::string(number) == "2")
        << number;
  }
}

TEST_F(ParticleSeries, HaveOneRangeOfColors) {
  const std::string file = growing(2);
  const std::vector<std::string> camera = {"--quick", "--color", "heat"};
  render(file, "f#.ppm", {"--quick", "--color", "heat", "--frames", "0-1"});
  // The range of frame 0, 1st to 99th percentile of -3, -1, 1, 3, ends before the numbers of frame
  // 1: its colours are those of the map's ends.
  render(file, "own.ppm", {"--quick", "--color", "heat", "--frame", "1"});
  EXPECT_FALSE(read("f1.ppm") == read("own.ppm"));
}

TEST_F(ParticleSeries, KeepTheirColors) {
  // The kinds come in another order in each frame, and the last one has a new one.
  const std::string file = write("kinds.xyz",
                                 "2\n\nwall 0 0 0\nbead 3 0 0\n2\n\nbead 3 0 0\nwall 0 0 0\n"
                                 "3\n\nfoam 9 9 9\nbead 3 0 0\nwall 0 0 0\n");
  const std::vector<std::string> fixed = {"--quick", "--view", "-z", "--up", "y", "--radius", "1"};
  std::vector<std::string> series = fixed;
  series.insert(series.end(), {"--frames", "0-1"});
  render(file, "f#.ppm", series);
  EXPECT_TRUE(read("f0.ppm") == read("f1.ppm"));
  series.insert(series.end(), {"--select", "species != 'foam'"});
  series[series.size() - 3] = "0-2";
  render(file, "g#.ppm", series);
  EXPECT_TRUE(read("g0.ppm") == read("g2.ppm"));
}

/// Frames that show nothing choose nothing: a series has the pictures that it has without them.
TEST_F(ParticleSeries, EmptyFirstFramesChangeNoChoice) {
  const std::string empty = "0\n\n";
  for (const std::string away : {"1", "100001"}) {  // so far from 0 they need an origin
    const std::string shown = "2\n\nC " + away + "0.5 0 5\nC " + away + "1 0 0\n3\n\nC " + away +
                              "0 0 0\nC " + away + "2.25 0 0\nO " + away + "3 0 5\n";
    const std::string all = write("all.xyz", empty + empty + shown);
    const std::string rest = write("rest.xyz", shown);
    for (const std::vector<std::string>& look :
         {std::vector<std::string>{"--radius", "0.5"}, {"--floor"}, {"--color", "x"}}) {
      const auto series = [&](const std::string& frames) {
        std::vector<std::string> options = look;
        options.insert(options.end(), {"--frames", frames});
        return options;
      };
      const ProgramRun run = render(all, "f#.ppm", series("0-3"));
      EXPECT_THAT(run.err, HasSubstr("the camera is fitted to all 4 frames"));
      render(rest, "g#.ppm", series("0-1"));
      EXPECT_TRUE(read("f2.ppm") == read("g0.ppm")) << look.front() << away;
      EXPECT_TRUE(read("f3.ppm") == read("g1.ppm")) << look.front() << away;
    }
  }
  render(path("all.xyz"), "f#.ppm", {"--frames", "0-3", "--legend", path("l.svg")});
  EXPECT_THAT(read("l.svg"), AllOf(HasSubstr(">C</text>"), HasSubstr(">O</text>")));
}

/// A kind that the first frame has not has one colour in all others, whatever else comes there.
TEST_F(ParticleSeries, ThatComeLaterHaveOneColor) {
  const std::string file = write("kinds.xyz",
                                 "1\n\nwall 0 0 0\n2\n\nwall 0 0 0\nbead 2 0 0\n"
                                 "3\n\nwall 0 0 0\nfoam 4 0 0\nbead 2 0 0\n");
  const std::string scene =
      write("kinds.toml",
            "schema = 1\n[[particles]]\nfile = \"kinds.xyz\"\nradius = 1.0\n"
            "select = \"species != 'foam'\"\n[camera]\neye = [1.0, 0.0, 9.0]\n"
            "look_at = [1.0, 0.0, 0.0]\n");
  for (const std::string& shown : {file, scene}) {
    std::vector<std::string> options = {"--frames", "0-2", "--legend", path("l.svg")};
    if (shown == file) options.insert(options.end(), {"--select", "species != 'foam'"});
    render(shown, "f#.ppm", options);
    EXPECT_TRUE(read("f1.ppm") == read("f2.ppm")) << shown;
    EXPECT_FALSE(read("f0.ppm") == read("f1.ppm")) << shown;
    EXPECT_THAT(read("l.svg"), AllOf(HasSubstr(">wall</text>"), HasSubstr(">bead</text>")));
  }
}

/// A column may be of texts in some frames and of numbers in others.
TEST_F(ParticleSeries, ColorsMatchTheirOwnFrame) {
  const std::string texts = "2\nProperties=species:S:1:pos:R:3:label:S:1\nC 0 0 0 a\nC 2 0 0 b\n";
  const std::string numbers = "2\nProperties=species:S:1:pos:R:3:label:I:1\nC 0 0 0 1\nC 2 0 0 2\n";
  const std::string file = write("labels.xyz", texts + numbers + texts);
  render(file, "f#.ppm", {"--frames", "0-2", "--color", "label"});
  EXPECT_TRUE(read("f0.ppm") == read("f2.ppm"));
}

TEST_F(ParticleSeries, OfASceneAreASeriesToo) {
  growing(2);
  const std::string scene = write("s.toml",
                                  "schema = 1\n[[particles]]\nfile = \"growing.xyz\"\n"
                                  "[camera]\nfit = true\ndirection = [0, 0, -1]\n");
  render(scene, "f#.ppm", {"--frames", "0-1"});
  write("one.toml", read("s.toml"));
  render(path("one.toml"), "last.ppm");  // frame 1
  EXPECT_TRUE(read("f1.ppm") == read("last.ppm"));
  render(path("one.toml"), "g#.ppm", {"--frames", "0"});
  EXPECT_FALSE(read("f0.ppm") == read("g0.ppm"));
}

/// A process that renders one frame alone chooses what the others do, and tells it once.
TEST_F(ParticleSeries, ChooseOnceWhoeverRendersThem) {
  std::string text = "0\n\n";
  for (const char* side : {"2", "1", "4"})
    text += "3\n\nA 0 0 0\nA " + std::string(side) + " 0 0\nA 0 " + side + " 0\n";
  const std::string file = write("grow.xyz", text);
  const std::vector<std::string> claim = {"--quick", "--frames", "0-3", "--claim"};
  const ProgramRun run = render(file, "c#.ppm", claim);
  for (const char* note : {"grow.xyz: the radius is half the typical distance to the nearest "
                           "neighbour, 0.5, the smallest of all 4 frames\n",
                           "the camera is fitted to all 4 frames\n"}) {
    EXPECT_THAT(run.err, HasSubstr(note));
    EXPECT_EQ(run.err.find(note), run.err.rfind(note)) << note;
  }
  const std::string third = read("c3.ppm");
  std::filesystem::remove(path("c3.ppm"));
  EXPECT_THAT(render(file, "c#.ppm", claim).err, HasSubstr("the smallest of all 4 frames"));
  EXPECT_TRUE(read("c3.ppm") == third);
  // With that radius for all nothing changes.
  render(file, "r#.ppm", {"--quick", "--frames", "0-3", "--radius", "0.5"});
  for (const char* number : {"0", "1", "2", "3"})
    EXPECT_TRUE(read(std::string("c") + number + ".ppm") ==
                read(std::string("r") + number + ".ppm"));
}

TEST_F(ParticleSeries, MakeAMovie) {
  const std::string file = growing(2);
  render(file, "f#.ppm", {"--quick", "--frames", "0-1"});
  const ProgramRun run = boule_run({"render", file, "--quick", "--size", "40x30", "--frames", "0-1",
                                    "--spp", "2", "-o", "-", "--format", "ppm"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out == read("f0.ppm") + read("f1.ppm"));
}

TEST_F(ParticleSeries, OfFilesHaveOneCamera) {
  const std::string all = read_bytes(growing(2));
  const std::size_t middle = all.find("4\nProperties", 1);
  write("part.00.xyz", all.substr(0, middle));
  write("part.01.xyz", all.substr(middle));
  render(path("growing.xyz"), "f#.ppm", {"--quick", "--frames", "0-1"});
  render(path("part.##.xyz"), "g#.ppm", {"--quick", "--frames", "0-1"});
  EXPECT_TRUE(read("f0.ppm") == read("g0.ppm"));
  EXPECT_TRUE(read("f1.ppm") == read("g1.ppm"));
}

TEST_F(ParticleSeries, BrokenFrameEndsTheSeriesThere) {
  const std::string all = read_bytes(growing(2));
  const std::size_t middle = all.find("4\nProperties", 1);
  write("part.0.xyz", all.substr(0, middle));
  const ProgramRun run = boule_run({"render", path("part.#.xyz"), "--quick", "--size", "40x30",
                                    "--frames", "0-1", "-o", path("h#.ppm")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("frame 1: "), Not(HasSubstr("is fitted to"))));
  EXPECT_THAT(files(), ElementsAre("growing.xyz", "h0.ppm", "part.0.xyz"));
}

}  // namespace
}  // namespace boule::test
