// Pictures of particle files without a scene: one command, the scene that it makes, series.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/render/cli/program.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Particles : public ProgramTest {
 protected:
  /// Two atoms of water in a cell, with a speed.
  std::string water() const {
    return write("water.xyz",
                 "3\nLattice=\"4 0 0 0 4 0 0 0 4\" Properties=species:S:1:pos:R:3:speed:R:1\n"
                 "O 1 1 1 0.5\nH 2 1 1 1.5\nH 1 2 1.2 2.5\n");
  }
  /// A trajectory that grows: four atoms in a square, twice as far apart in each frame.
  std::string growing(int frames) const {
    std::string text;
    double side = 1;
    for (int frame = 0; frame < frames; ++frame, side *= 2) {
      text += "4\nProperties=species:S:1:pos:R:3:heat:R:1\n";
      for (const char* corner : {"-1 -1", "-1 1", "1 -1", "1 1"}) {
        const double x = corner[0] == '-' ? -side : side;
        const double y = std::string(corner).ends_with("-1") ? -side : side;
        text += "C " + std::to_string(x) + " " + std::to_string(y) + " 0 " +
                std::to_string(x + 2 * y) + "\n";
      }
    }
    return write("growing.xyz", text);
  }
  ProgramRun render(const std::string& file, const std::string& picture,
                    std::vector<std::string> options = {}) const {
    std::vector<std::string> arguments = {"render", file, "-o", path(picture), "--size", "40x30"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), {"--spp", "2"});
    ProgramRun run = boule_run(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run;
  }
  /// The scene of a file, in the test's folder.
  std::string scene_of(const std::string& file, std::vector<std::string> options) const {
    std::vector<std::string> arguments = {"scene", file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = boule_run(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return write("made.toml", run.out);
  }
};

TEST_F(Particles, AreShownByTheSceneThatIsPrinted) {
  const std::string file = water();
  const std::vector<std::vector<std::string>> looks = {
      {},
      {"--quick"},
      {"--floor", "--view", "1,2,-0.5"},
      {"--look", "dark", "--color", "speed", "--map", "turbo", "--range", "0,2"},
      {"--look", "plain", "--color", "#4080c0", "--radius", "0.5", "--scale", "0.7", "--up", "y"},
      {"--select", "speed > 1", "--color", "element", "--radius", "covalent", "--view", "-z"}};
  for (const std::vector<std::string>& look : looks) {
    render(file, "direct.exr", look);
    render(scene_of(file, look), "made.exr");
    EXPECT_TRUE(read("direct.exr") == read("made.exr")) << (look.empty() ? "" : look.front());
  }
}

TEST_F(Particles, AreKnownByTheirContentToo) {
  render(water(), "a.ppm");
  write("conf", read("water.xyz"));
  render(path("conf"), "b.ppm");
  EXPECT_TRUE(read("a.ppm") == read("b.ppm"));
  write("conf.dat", read("water.xyz"));
  render(path("conf.dat"), "c.ppm", {"--input-format", "xyz"});
  EXPECT_TRUE(read("a.ppm") == read("c.ppm"));
}

TEST_F(Particles, FilesOfNoKnownKindAreRefused) {
  const std::string file = write("notes.abc", "nothing of the kind\n");
  const ProgramRun run = refused_run({"render", file, "-o", path("a.png")}, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("notes.abc: error: neither a scene nor particles"),
                             HasSubstr(".toml .nff .npy"), HasSubstr(".xyz")));
  EXPECT_EQ(refused_run({"info", file}, 3).err, run.err);
  EXPECT_THAT(refused_run({"info", path("none")}, 3).err,
              HasSubstr("none: error: cannot read it: No such file or directory"));
  EXPECT_THAT(refused_run({"scene", file}, 2).err,
              AllOf(HasSubstr("notes.abc: error: particles are expected"), HasSubstr(".xyz")));
  EXPECT_THAT(refused_run({"info", write("part.film", "x")}, 3).err, HasSubstr("boule merge"));
}

TEST_F(Particles, OptionsThatDoNotFitTheFileAreWrongUsage) {
  const std::string file = water();
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--color", "sped"}, "'sped'"},
      {{"--radius", "size"}, "'size'"},
      {{"--select", "speed >"}, "(key '--select')"},
      {{"--frame", "1"}, "has no frame 1"},
      {{"--view", "y", "--up", "-y"}, "(key '--up')"}};
  for (const auto& [options, text] : wrong) {
    std::vector<std::string> arguments = {"render", file, "-o", path("a.png")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_THAT(refused_run(arguments, 2).err,
                AllOf(HasSubstr(text), HasSubstr("'" + options[options.size() - 2] + "'"),
                      Not(HasSubstr("the scene of"))));
  }
}

TEST_F(Particles, OptionsOfParticlesAreNotForScenes) {
  const std::string scene = small_scene();
  for (const char* option : {"--floor", "--quick"}) {
    EXPECT_THAT(refused_run({"render", scene, "-o", path("a.png"), option}, 2).err,
                AllOf(HasSubstr("is none by its name"), HasSubstr(option)));
  }
  EXPECT_THAT(refused_run({"info", scene, "--frame", "1"}, 2).err, HasSubstr("(key '--frame')"));
  EXPECT_THAT(refused_run({"scene", scene}, 2).err, HasSubstr("is none by its name"));
}

TEST_F(Particles, ErrorsOfTheFileAreAtTheirLine) {
  const std::string file = write("bad.xyz", "2\n\nC 0 0 0\nC 0 nothing 0\n");
  const ProgramRun run = refused_run({"render", file, "-o", path("a.png")}, 3);
  EXPECT_THAT(run.err, HasSubstr("bad.xyz:4:5: error: "));
  const std::string latin = write("caf\xe9.xyz", "1\n\nC 0 0 0\n");
  EXPECT_THAT(refused_run({"render", latin, "-o", path("a.png")}, 3).err,
              HasSubstr("error: its name, or an option, is not UTF-8"));
  const ProgramRun missing = refused_run({"render", path("no.xyz"), "-o", path("a.png")}, 3);
  EXPECT_THAT(missing.err, HasSubstr("no.xyz: error: "));
}

TEST_F(Particles, HaveColumnsThatTheCommandLineNames) {
  const std::string file = write("sph.lmp",
                                 "water\n\n2 atoms\n\nAtoms\n\n"
                                 "1 1 1000 0 1 0.5 2 3 0 0 0\n2 1 990 0 1 1.5 2 3 0 0 0\n");
  EXPECT_THAT(refused_run({"info", file}, 3).err, HasSubstr("(--columns id,type,x,y,z)"));
  const std::string names = "id,type,rho,e,cv,x,y,z";
  const ProgramRun told = boule_run({"info", file, "--json", "--columns", names});
  ASSERT_EQ(told.exit_code, 0) << told.err;
  const auto info = nlohmann::json::parse(told.out);
  EXPECT_EQ(info["bounds"]["high"], nlohmann::json::parse("[1.5,2.0,3.0]"));
  EXPECT_EQ(info["columns"][2]["name"], "rho");
  render(file, "a.ppm", {"--columns", names, "--color", "rho"});
  const ProgramRun wrong = refused_run({"info", file, "--columns", "id,type,rho,x,y"}, 3);
  EXPECT_THAT(wrong.err, HasSubstr("there is no column of positions for z"));
}

TEST_F(Particles, OfPlainArraysAreShownByTheirOptions) {
  // Centres alone: as a scene they lack radii.
  const std::string file =
      write("row.npy", npy_file(npy_dict("'<f8'", "(2, 3)"), std::string(48, '\0')));
  EXPECT_THAT(refused_run({"render", file, "-o", path("a.ppm")}, 3).err, HasSubstr("radius"));
  render(file, "a.ppm", {"--radius", "0.5"});
  EXPECT_THAT(boule_run({"info", file, "--input-format", "npy"}).out, HasSubstr("particles: 2"));
}

TEST_F(Particles, AreDescribed) {
  const ProgramRun run = boule_run({"info", water(), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto info = nlohmann::json::parse(run.out);
  EXPECT_EQ(info["format"], "xyz");
  EXPECT_EQ(info["frames"], 1);
  EXPECT_EQ(info["particles"], 3);
  EXPECT_EQ(info["species"],
            nlohmann::json::parse(R"([{"name":"O","count":1},{"name":"H","count":2}])"));
  EXPECT_EQ(info["columns"],
            nlohmann::json::parse(R"([{"name":"speed","least":0.5,"largest":2.5}])"));
  EXPECT_EQ(info["cell"]["b"], nlohmann::json::parse("[0.0,4.0,0.0]"));
  EXPECT_EQ(info["bounds"]["high"], nlohmann::json::parse("[2.0,2.0,1.2]"));
  EXPECT_EQ(info["picture"]["spheres"], 3);
  EXPECT_THAT(info["picture"]["radius"].get<std::string>(), HasSubstr("van der Waals"));
  EXPECT_EQ(info["picture"]["camera"]["fov"], 20);
  const ProgramRun text = boule_run({"info", path("water.xyz")});
  EXPECT_THAT(text.out, AllOf(HasSubstr("particles: 3\n"), HasSubstr("\n  name H, count 2\n"),
                              HasSubstr("\n  name speed, least 0.5, largest 2.5\n")));
}

TEST_F(Particles, HaveALegend) {
  render(water(), "a.ppm", {"--color", "speed", "--legend", path("scale.svg")});
  EXPECT_THAT(read("scale.svg"), AllOf(HasSubstr(">speed</text>"), HasSubstr("</svg>\n")));
  render(water(), "a.ppm", {"--legend", path("species.svg")});
  EXPECT_THAT(read("species.svg"), AllOf(HasSubstr(">O</text>"), HasSubstr(">H</text>")));
  const std::vector<std::string> base = {"render", path("water.xyz"), "-o", path("b.ppm")};
  const auto with = [&base](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return more;
  };
  const std::string flat = "no particles whose colours mean";
  EXPECT_THAT(refused_run(with({"--color", "#ffffff", "--legend", path("l.svg")}), 2).err,
              HasSubstr(flat));
  EXPECT_THAT(refused_run(with({"--legend", path("l.png")}), 2).err, HasSubstr("ends with .svg"));
  write("water.svg", read("water.xyz"));
  EXPECT_THAT(refused_run({"render", path("water.svg"), "--input-format", "xyz", "-o",
                           path("b.ppm"), "--legend", path("water.svg")},
                          2)
                  .err,
              HasSubstr("the legend would replace"));
  EXPECT_THAT(refused_run(with({"--legend", path("none/l.svg")}), 1).err, HasSubstr("l.svg"));
}

TEST_F(Particles, FarAwayHaveTheFloorThatTheyHaveAtZero) {
  const std::vector<std::string> options = {"--look", "plain", "--floor", "--radius", "0.3"};
  const std::string near = "2\n\nC 0.25 0.125 0.5\nO 1.75 2 0.375\n";
  render(write("near.xyz", near), "near.ppm", options);
  const std::string far =
      "2\n\nC 1000000.25 1000000.125 1000000.5\nO 1000001.75 1000002 1000000.375\n";
  render(write("far.xyz", far), "far.ppm", options);
  EXPECT_TRUE(read("near.ppm") == read("far.ppm"));
}

TEST_F(Particles, OfASeriesHaveOneCamera) {
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

TEST_F(Particles, OfASeriesHaveOneRangeOfColors) {
  const std::string file = growing(2);
  const std::vector<std::string> camera = {"--quick", "--color", "heat"};
  render(file, "f#.ppm", {"--quick", "--color", "heat", "--frames", "0-1"});
  // The range of frame 0, 1st to 99th percentile of -3, -1, 1, 3, ends before the numbers of frame
  // 1: its colours are those of the map's ends.
  render(file, "own.ppm", {"--quick", "--color", "heat", "--frame", "1"});
  EXPECT_FALSE(read("f1.ppm") == read("own.ppm"));
}

TEST_F(Particles, OfASeriesKeepTheirColors) {
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
TEST_F(Particles, OfASeriesThatBeginsWithNoneChooseAllTheSame) {
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
TEST_F(Particles, OfASeriesThatComeLaterHaveOneColor) {
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
TEST_F(Particles, OfASeriesHaveColorsAsTheirOwnFrameHasThem) {
  const std::string texts = "2\nProperties=species:S:1:pos:R:3:label:S:1\nC 0 0 0 a\nC 2 0 0 b\n";
  const std::string numbers = "2\nProperties=species:S:1:pos:R:3:label:I:1\nC 0 0 0 1\nC 2 0 0 2\n";
  const std::string file = write("labels.xyz", texts + numbers + texts);
  render(file, "f#.ppm", {"--frames", "0-2", "--color", "label"});
  EXPECT_TRUE(read("f0.ppm") == read("f2.ppm"));
}

TEST_F(Particles, OfASceneAreASeriesToo) {
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
TEST_F(Particles, OfASeriesChooseOnceWhoeverRendersThem) {
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

TEST_F(Particles, OfASeriesMakeAMovie) {
  const std::string file = growing(2);
  render(file, "f#.ppm", {"--quick", "--frames", "0-1"});
  const ProgramRun run = boule_run({"render", file, "--quick", "--size", "40x30", "--frames", "0-1",
                                    "--spp", "2", "-o", "-", "--format", "ppm"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out == read("f0.ppm") + read("f1.ppm"));
}

TEST_F(Particles, OfASeriesOfFilesHaveOneCamera) {
  const std::string all = read_bytes(growing(2));
  const std::size_t middle = all.find("4\nProperties", 1);
  write("part.00.xyz", all.substr(0, middle));
  write("part.01.xyz", all.substr(middle));
  render(path("growing.xyz"), "f#.ppm", {"--quick", "--frames", "0-1"});
  render(path("part.##.xyz"), "g#.ppm", {"--quick", "--frames", "0-1"});
  EXPECT_TRUE(read("f0.ppm") == read("g0.ppm"));
  EXPECT_TRUE(read("f1.ppm") == read("g1.ppm"));
}

TEST_F(Particles, AFrameThatIsBrokenEndsTheSeriesThere) {
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
