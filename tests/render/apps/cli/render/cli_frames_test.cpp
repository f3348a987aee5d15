// Series of frames: each is what a single render of it would be.
#include <csignal>

#include "tests/render/apps/cli/program.h"
#include "tests/render/apps/cli/running_program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Frames : public ProgramTest {
 protected:
  std::string scene_text(const std::string& camera) const {
    return "schema = 1\n[image]\nsize = [24, 16]\n[camera]\nlook_at = [0, 0, 0]\n" + camera +
           "[background]\ntype = \"gradient\"\n[[sphere]]\n";
  }
  std::string moving_scene() const {
    return write("scene.toml",
                 scene_text("[[camera.key]]\nframe = 1\neye = [0, 0, 4]\nfov = 40\n"
                            "[[camera.key]]\nframe = 3\neye = [2, 1, 4]\n"
                            "[[camera.key]]\nframe = 9\neye = [4, 0, 0]\nfov = 60\n"));
  }
};

TEST_F(Frames, EachIsTheSingleRenderOfIt) {
  const std::string scene = moving_scene();
  const ProgramRun run =
      boule_run({"render", scene, "-o", path("out.##.exr"), "--frames", "2-4", "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("out.02.exr", "out.03.exr", "out.04.exr", "scene.toml"));
  const std::string still = write("still.toml", scene_text("eye = [2, 1, 4]\nfov = 45\n"));
  EXPECT_NE(read("out.02.exr"), read("out.03.exr"));
  for (const char* number : {"2", "3", "4"}) {
    EXPECT_EQ(
        boule_run({"render", scene, "-o", path("one#.exr"), "--frames", number, "-q"}).exit_code,
        0);
    EXPECT_EQ(read(std::string("one") + number + ".exr"),
              read(std::string("out.0") + number + ".exr"));
  }
  const std::string at_key = write("key.toml", scene_text("eye = [4, 0, 0]\nfov = 60\n"));
  EXPECT_EQ(boule_run({"render", at_key, "-o", path("k.exr"), "-q"}).exit_code, 0);
  EXPECT_EQ(boule_run({"render", scene, "-o", path("m#.exr"), "--frames=9", "-q"}).exit_code, 0);
  EXPECT_EQ(read("m9.exr"), read("k.exr"));
}

TEST_F(Frames, SceneAndStatisticsNamesHaveTheNumber) {
  write("a.0007.toml", scene_text("eye = [0, 0, 4]\n"));
  write("a.0008.toml", scene_text("eye = [0, 2, 4]\n"));
  const ProgramRun run = boule_run({"render", path("a.####.toml"), "-o", path("b.###.ppm"),
                                    "--frames", "7-8", "-q", "--stats", "json:" + path("s#.json")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(files(), ElementsAre("a.0007.toml", "a.0008.toml", "b.007.ppm", "b.008.ppm",
                                   "s7.json", "s8.json"));
  EXPECT_EQ(boule_run({"render", path("a.0008.toml"), "-o", path("c.ppm"), "-q"}).exit_code, 0);
  EXPECT_EQ(read("b.008.ppm"), read("c.ppm"));
}

TEST_F(Frames, ErrorNamesTheFrameAndEndsThere) {
  write("a.1.toml", scene_text("eye = [0, 0, 4]\n"));
  write("a.2.toml", scene_text("eye = [0, 0, 0]\n"));
  write("a.3.toml", scene_text("eye = [0, 0, 4]\n"));
  const ProgramRun run =
      boule_run({"render", path("a.#.toml"), "-o", path("b.#.ppm"), "--frames", "1-3", "-q"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("a.2.toml:5:11: error: frame 2: "));
  EXPECT_THAT(files(), ElementsAre("a.1.toml", "a.2.toml", "a.3.toml", "b.1.ppm"));
}

TEST_F(Frames, ASignalLeavesTheFramesBefore) {
  for (const char* name : {"a.1.toml", "a.2.toml"}) write(name, scene_text("eye = [0, 0, 4]\n"));
  RunningProgram program({"render", path("a.#.toml"), "-o", path("o#.ppm"), "--frames", "1-2"},
                         Hold{"open", path("a.2.toml")});
  ASSERT_TRUE(program.wait_for_hold());
  program.send(SIGTERM);
  const ProgramRun run = program.finish();
  EXPECT_EQ(run.exit_code, 143);
  EXPECT_THAT(run.out, HasSubstr("interrupted (SIGTERM), earlier frames had been written"));
  EXPECT_THAT(files(), ElementsAre("a.1.toml", "a.2.toml", "o1.ppm"));
  const std::string first = read("o1.ppm");
  EXPECT_EQ(boule_run({"render", path("a.1.toml"), "-o", path("o1.ppm"), "-q"}).exit_code, 0);
  EXPECT_EQ(read("o1.ppm"), first);
}

TEST_F(Frames, FinishedFramesAreSkippedOnRequest) {
  for (const char* extension : {"exr", "png", "jpg", "ppm"}) {
    const std::string name = std::string("o#.") + extension;
    const auto frame = [&](int i) { return "o" + std::to_string(i) + "." + extension; };
    const std::vector<std::string> arguments = {"render",   moving_scene(), "-o",
                                                path(name), "--frames",     "1-4"};
    ASSERT_EQ(boule_run(arguments).exit_code, 0);
    const std::string first = read(frame(1)), second = read(frame(2)), third = read(frame(3));
    write(frame(1), first.substr(0, first.size() / 2));  // cut off
    write(frame(2), "no picture");
    EXPECT_EQ(boule_run({"render", moving_scene(), "-o", path(name), "--frames", "3", "--size",
                         "8x8", "-q"})
                  .exit_code,
              0);  // of another size
    std::vector<std::string> again = arguments;
    again.insert(again.end(), {"--skip-existing", "-v"});
    const ProgramRun run = boule_run(again);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr(name + ": 4 frames, 1 of them there already, "));
    EXPECT_THAT(run.err, testing::Not(HasSubstr(frame(3) + ": is there already")));
    EXPECT_THAT(run.err, HasSubstr(frame(4) + ": is there already, skipped"));
    EXPECT_EQ(read(frame(1)), first);
    EXPECT_EQ(read(frame(2)), second);
    EXPECT_EQ(read(frame(3)), third);
  }
}

TEST_F(Frames, APartialPictureIsNotSkipped) {
  for (const char* name : {"o.exr", "o.png", "o.jpg", "o.tif"}) {
    const std::vector<std::string> arguments = {"render", small_scene(), "-o", path(name),
                                                "--size", "600x400",     "-q"};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), arguments.begin(), arguments.end());
      EXPECT_EQ(boule_run(more).exit_code, 0);
      return read(name);
    };
    RunningProgram partial({"render", small_scene(), "-o", path(name), "--size", "600x400", "--spp",
                            "2000000000", "--partial"});
    ASSERT_TRUE(partial.wait_for("Mray/s"));
    partial.send(SIGINT);
    EXPECT_EQ(partial.finish().exit_code, 130);
    const std::string finished = with({"--skip-existing"});
    EXPECT_EQ(with({}), finished);
    EXPECT_EQ(with({"--skip-existing", "--seed", "5", "--spp", "2"}), finished);
  }
}

TEST_F(Frames, OtherCropsOrChannelsAreNotSkipped) {
  const std::vector<std::vector<std::string>> shapes = {{"--crop", "0,0,4,4"},
                                                        {"--crop", "0,1,4,5"},
                                                        {"--crop", "0,1,4,5", "--aov", "depth"},
                                                        {"--crop", "0,1,4,5", "--aov", "id"},
                                                        {"--size", "4x4"},
                                                        {"--size", "4x4", "--aov", "depth,id"}};
  for (const auto& shape : shapes) {
    std::vector<std::string> arguments = {"render", moving_scene(), "-o", path("o.exr"),
                                          "--skip-existing"};
    arguments.insert(arguments.end(), shape.begin(), shape.end());
    EXPECT_THAT(boule_run(arguments).err, testing::Not(HasSubstr("is there already")));
    EXPECT_THAT(boule_run(arguments).err, HasSubstr("is there already, skipped"));
  }
}

TEST_F(Frames, InfoTellsOfEach) {
  write("a.0007.toml", scene_text("eye = [0, 0, 4]\n"));
  write("a.0008.toml", scene_text("eye = [0, 2, 4]\n"));
  const ProgramRun run = boule_run({"info", path("a.####.toml"), "--frames", "7-8"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("eye 0.0 0.0 4.0"));
  EXPECT_THAT(run.out, HasSubstr("eye 0.0 2.0 4.0"));
  const ProgramRun key = boule_run({"info", moving_scene(), "--frames", "9"});
  EXPECT_THAT(key.out, HasSubstr("eye 4.0 0.0 0.0"));
}

TEST_F(Frames, EveryFourth) {
  const ProgramRun run =
      boule_run({"render", moving_scene(), "-o", path("out.#.ppm"), "--frames", "1-12:4", "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(files(), ElementsAre("out.1.ppm", "out.5.ppm", "out.9.ppm", "scene.toml"));
  for (const char* name : {"a.3.toml", "a.5.toml"}) write(name, scene_text("eye = [0, 0, 4]\n"));
  const ProgramRun info = boule_run({"info", path("a.#.toml"), "--frames=3-5:2"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
}

TEST_F(Frames, PlacesForANumberAskForFrames) {
  const std::string scene = moving_scene();
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"render", scene, "-o", path("o.####.ppm")},
           {"render", scene, "-o", path("o.ppm"), "--stats=json:" + path("s##.json")},
           {"render", path("a.####.toml"), "-o", path("o.ppm")},
           {"info", path("a.####.toml")}}) {
    EXPECT_THAT(refused_run(arguments, 2).err, HasSubstr(": --frames is missing (key '"));
  }
  const std::string dust = write("dust.toml", "schema = 1\n[[spheres]]\nfile = \"d.##.npy\"\n");
  const ProgramRun run = refused_run({"render", dust, "-o", path("o.ppm")}, 3);
  EXPECT_THAT(run.err, testing::StartsWith(dust + ":3:8: error: 'd.##.npy' is not there, "));
  EXPECT_THAT(run.err, HasSubstr(": --frames is missing (key 'spheres[0].file')"));
  // What is there is meant as it stands, and so is a single mark in a name.
  std::filesystem::rename(scene, path("scene.##.toml"));
  const ProgramRun hash = boule_run({"render", path("scene.##.toml"), "-o", path("c#.ppm"), "-q"});
  EXPECT_EQ(hash.exit_code, 0) << hash.err;
  EXPECT_THAT(files(), ElementsAre("c#.ppm", "dust.toml", "scene.##.toml"));
}

TEST_F(Frames, WrongRangesAndNamesAreRefused) {
  for (const char* range : {"", "a", "4-2", "-1-2", "1-", "1-2-3", "1.5", "0-1000000000", "1-4:",
                            "1-4:0", "1-4:-1", "1-4:x", "1-4:2:2", "1:2", ":2", "1-4:1000000000"}) {
    const ProgramRun run = refused_run(
        {"render", moving_scene(), "-o", path("o#.ppm"), std::string("--frames=") + range}, 2);
    EXPECT_THAT(run.err, HasSubstr("--frames")) << range;
  }
  refused_run({"render", moving_scene(), "-o", path("o.ppm"), "--frames", "1-2"}, 2);
  const ProgramRun run = refused_run({"render", moving_scene(), "-o", path("o#.ppm"), "--frames",
                                      "1-2", "--stats", "json:" + path("s.json")},
                                     2);
  EXPECT_THAT(run.err, HasSubstr("--stats"));
}

}  // namespace
}  // namespace boule::test
