// --preview: the picture as far as it is, renewed while the program works.
#include <csignal>
#include <thread>

#include "tests/render/apps/cli/parts/part_program.h"
#include "tests/render/apps/cli/running_program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Preview : public PartTest {
 protected:
  /// `render` of a picture without channels, which a preview leaves out.
  std::vector<std::string> plain(const std::string& output,
                                 const std::vector<std::string>& more = {},
                                 const std::string& spp = "20") const {
    std::vector<std::string> words = {"render",   small_scene(), "-o",     path(output), "--size",
                                      "97x61",    "--spp",       spp,      "--outline",  "1.5",
                                      "--method", "path",        "--tile", "16",         "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(Preview, EndsWithTheSamePicture) {
  ASSERT_EQ(boule_run(plain("whole.exr")).exit_code, 0);
  const std::string whole = read("whole.exr");
  for (const char* interval : {"1ms", "60s"}) {
    const ProgramRun run =
        boule_run(plain("out.exr", {"--preview", path("now.exr") + "," + interval}));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read("out.exr"), whole);
    EXPECT_EQ(read("now.exr"), whole);
    EXPECT_THAT(files(), ElementsAre("now.exr", "out.exr", "scene.toml", "whole.exr"));
  }
}

TEST_F(Preview, ComesWhileTheProgramWorks) {
  RunningProgram program(render("out.exr", {"--preview", path("now.exr") + ",20ms"}, "100000"));
  while (!std::filesystem::exists(path("now.exr")))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const std::string first = read("now.exr");
  while (read("now.exr") == first) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  program.send(SIGTERM);
  const ProgramRun run = program.finish();
  EXPECT_EQ(run.exit_code, 128 + SIGTERM) << run.out;
  EXPECT_THAT(files(), ElementsAre("now.exr", "scene.toml"));
  EXPECT_THAT(first, HasSubstr("partial: "));
}

/// Each renews its own file.
TEST_F(Preview, GoesWithACheckpoint) {
  const std::string whole = whole_picture();
  const ProgramRun run = boule_run(render("out.exr", {"--preview", path("now.png") + ",1ms",
                                                      "--checkpoint", path("run.film") + ",1ms"}));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("out.exr"), whole);
  EXPECT_THAT(files(), ElementsAre("now.png", "out.exr", "scene.toml", "whole.exr"));
}

TEST_F(Preview, GoesWithANoiseTarget) {
  ASSERT_EQ(boule_run(render_noise("whole.exr")).exit_code, 0);
  const ProgramRun run =
      boule_run(render_noise("out.exr", {"--preview", path("now.exr") + ",1ms"}));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read("out.exr"), read("whole.exr"));
}

TEST_F(Preview, FaultsAreToldBeforeRendering) {
  const auto refuse = [&](const std::string& preview, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"--preview", preview};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_THAT(refused_run(plain("out.exr", words), 2).err, HasSubstr("--preview"));
  };
  refuse(path("now.xyz"));
  refuse(path("out.exr"));
  refuse(path("scene.toml"));
  refuse(path("now.jpg"), {"--background", "transparent"});
  refuse(path("now.####.png"));
  refuse(path("now.png") + ",0s");
  refused_run(plain("out.exr", {"--preview", path("nowhere/now.png")}), 1);
  EXPECT_THAT(files(), ElementsAre("scene.toml"));
}

}  // namespace
}  // namespace boule::test
