// Pictures of particle files without a scene: one command, the scene that it makes.
#include <nlohmann/json.hpp>

#include "tests/render/apps/cli/particles/particles_fixture.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Particles = ParticlesTest;

TEST_F(Particles, PrintedSceneShowsThem) {
  const std::string file = water();
  const std::vector<std::vector<std::string>> looks = {
      {},
      {"--quick"},
      {"--floor", "--view", "1,2,-0.5"},
      {"--colors", "O=crimson,h=#336699", "--radii", "O=1.5", "--wrap", "--replicate", "2x1x2"},
      {"--unwrap", "--boundary", "--bonds", "distance"},
      {"--color", "speed", "--map", "Navy,white", "--nan-color", "gold"},
      {"--color", "teal", "--colors", "O=red"},
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

TEST_F(Particles, OptionsMustFitTheFile) {
  const std::string file = water();
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--color", "sped"}, "'sped'"},
      {{"--colors", "Oo=red"}, "(key '--colors')"},
      {{"--radii", "Oo=1"}, "(key '--radii')"},
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

TEST_F(Particles, FileErrorsNameTheirLine) {
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

TEST_F(Particles, PlainArraysAreShownByOptions) {
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

TEST_F(Particles, InfoDescribesNanAsDrawn) {
  const std::string file = write("forces.xyz",
                                 "3\nProperties=species:S:1:pos:R:3:f:R:1:g:R:1:h:L:1\n"
                                 "Ar 1 1 1 nan inf T\nAr 4 4 4 2 3 maybe\nAr 1 4 4 nan x F\n");
  render(file, "a.ppm");
  const ProgramRun run = boule_run({"info", file, "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto info = nlohmann::json::parse(run.out);
  EXPECT_EQ(info["columns"], nlohmann::json::parse(R"([
      {"name":"f","least":2.0,"largest":2.0,"missing":2},
      {"name":"g","least":3.0,"largest":3.0,"missing":1,"infinite":1},
      {"name":"h","least":0.0,"largest":1.0,"missing":1}])"));
  EXPECT_THAT(refused_run({"render", file, "--color", "g", "-o", path("b.ppm")}, 3).err,
              HasSubstr("forces.xyz:3:14: error: expected a finite number, found 'inf'"));
  const ProgramRun colored = render(file, "c.ppm", {"--color", "f", "--legend", path("f.svg")});
  EXPECT_THAT(colored.err, HasSubstr("2 particles have no number in 'f'"));
  EXPECT_THAT(read("f.svg"), HasSubstr(">missing</text>"));
}

TEST_F(Particles, CutFileGivesItsWholeFrames) {
  const std::string frame = "2\n\nC 0 0 0\nC 1 0 0\n";
  const std::string file = write("run.xyz", frame + frame + "2\n\nC 0 0 0\n");
  const std::string cut = "the file is cut off in frame 2 (line 9: it promises 2 particles";
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, {"--frame", "0"}, {"--frames", "0-1"}}) {
    const bool is_series = !options.empty() && options[0] == "--frames";
    const ProgramRun run = render(file, is_series ? "a#.ppm" : "a.ppm", options);
    EXPECT_EQ(run.err.find(cut), run.err.rfind(cut)) << run.err;  // once
    EXPECT_THAT(run.err, HasSubstr(cut));
  }
  const ProgramRun none = refused_run({"render", file, "--frame", "2", "-o", path("b.ppm")}, 2);
  EXPECT_THAT(none.err, HasSubstr("has no frame 2, it has 2 frames, from 0 to 1: " + cut));
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

TEST_F(Particles, FarFloorMatchesTheOneAtZero) {
  const std::vector<std::string> options = {"--look", "plain", "--floor", "--radius", "0.3"};
  const std::string near = "2\n\nC 0.25 0.125 0.5\nO 1.75 2 0.375\n";
  render(write("near.xyz", near), "near.ppm", options);
  const std::string far =
      "2\n\nC 1000000.25 1000000.125 1000000.5\nO 1000001.75 1000002 1000000.375\n";
  render(write("far.xyz", far), "far.ppm", options);
  EXPECT_TRUE(read("near.ppm") == read("far.ppm"));
}

}  // namespace
}  // namespace boule::test
