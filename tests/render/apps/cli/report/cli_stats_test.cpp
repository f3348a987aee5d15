// --stats: what a render took, for people and for programs.
#include <nlohmann/json.hpp>

#include "simd/dispatch/dispatch.h"
#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Statistics : public ProgramTest {
 protected:
  ProgramRun render(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path("x.ppm"), "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return boule_run(arguments);
  }
};

/// Where the processors are not bound, Slurm's variable alone tells.
TEST_F(Statistics, ThreadsKeepToTheSlurmTask) {
  const auto threads = [&](const std::vector<std::string>& options, const std::string& processors) {
    std::vector<std::string> words = {"--stats", "json:-", "--size", "300x200"};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path("x.ppm"), "-q"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const ProgramRun run = boule_run(arguments, {"SLURM_CPUS_PER_TASK=" + processors});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out).at("threads").get<int>();
  };
  const int all = threads({}, "");
  EXPECT_EQ(threads({}, "1"), 1);
  EXPECT_EQ(threads({"-t", "0"}, "1"), 1);
  EXPECT_EQ(threads({"-t", "2"}, "1"), 2);
  for (const char* none : {"0", "-1", "many", "1000000"}) EXPECT_EQ(threads({}, none), all);
}

TEST_F(Statistics, JsonHasEveryFigure) {
  const ProgramRun run = render({"--stats", "json:-", "--spp", "3", "-t", "2", "--isa", "scalar"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, IsEmpty());
  const auto stats = nlohmann::json::parse(run.out);
  EXPECT_EQ(stats.size(), 14u);
  EXPECT_EQ(stats.at("samples_not_finite"), 0);
  EXPECT_EQ(stats.at("samples_too_bright"), 0);
  EXPECT_EQ(stats.at("schema"), 1);
  EXPECT_EQ("boule " + stats.at("version").get<std::string>() + "\n", boule_run({"--version"}).out);
  EXPECT_EQ(stats.at("isa"), "scalar");
  EXPECT_EQ(stats.at("width"), 1);
  EXPECT_EQ(stats.at("solver"), "robust");
  EXPECT_GE(stats.at("threads").get<int>(), 1);
  EXPECT_LE(stats.at("threads").get<int>(), 2);
  EXPECT_EQ(stats.at("size"), nlohmann::json({32, 18}));
  EXPECT_EQ(stats.at("spp"), 3);
  const auto& seconds = stats.at("seconds");
  EXPECT_EQ(seconds.size(), 5u);
  double sum = 0;
  for (const char* part : {"load", "prepare", "render", "write"}) {
    EXPECT_GT(seconds.at(part).get<double>(), 0) << part;
    sum += seconds.at(part).get<double>();
  }
  EXPECT_LE(sum, seconds.at("total").get<double>());
  const auto& rays = stats.at("rays");
  EXPECT_EQ(rays.size(), 3u);
  EXPECT_EQ(rays.at("primary"), 32 * 18 * 3);
  EXPECT_GT(rays.at("shadow").get<int>(), 0);
  EXPECT_GT(rays.at("continuation").get<int>(), 0);
  const double all = rays.at("primary").get<double>() + rays.at("shadow").get<double>() +
                     rays.at("continuation").get<double>();
  EXPECT_DOUBLE_EQ(stats.at("mrays_per_s").get<double>(),
                   all / seconds.at("render").get<double>() * 1e-6);
  EXPECT_EQ(stats.at("samples_not_finite"), 0);
  EXPECT_EQ(stats.at("samples_too_bright"), 0);
  EXPECT_GT(stats.at("peak_rss_mib").get<double>(), 1);
}

TEST_F(Statistics, JsonGoesToStandardOutputOrFile) {
  const auto without_times = [](const std::string& text) {
    auto stats = nlohmann::json::parse(text);
    for (const char* key : {"seconds", "mrays_per_s", "peak_rss_mib"}) stats.erase(key);
    return stats;
  };
  const auto on_output = without_times(render({"--stats", "json"}).out);
  const ProgramRun run = render({"--stats", "json:" + path("stats.json")});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_EQ(without_times(read("stats.json")), on_output);
  EXPECT_THAT(files(), testing::ElementsAre("scene.toml", "stats.json", "x.ppm"));
}

TEST_F(Statistics, TheyTellWhatReallyRan) {
  const auto stats = [&](const std::vector<std::string>& options) {
    auto all = options;
    all.insert(all.end(), {"--stats", "json"});
    return nlohmann::json::parse(render(all).out);
  };
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    const auto one = stats({"--isa", std::string(info.name)});
    EXPECT_EQ(one.at("isa"), std::string(info.name));
    EXPECT_EQ(one.at("width"), info.width);
  }
  EXPECT_EQ(stats({"--solver", "reference"}).at("solver"), "reference");
  EXPECT_EQ(stats({"--solver", "reference"}).at("isa"), "scalar");
  const auto crop = stats({"--crop", "3,4,9,8"});
  EXPECT_EQ(crop.at("size"), nlohmann::json({6, 4}));
  EXPECT_EQ(crop.at("rays").at("primary"), 24);
}

TEST_F(Statistics, TextGoesToStandardErrorWhenQuiet) {
  const ProgramRun run = render({"--stats", "text"});
  EXPECT_THAT(run.out, IsEmpty());
  for (const char* part : {"stats: ", "solver robust", "32 x 18 pixels, 1 spp", "load ", "prepare ",
                           "render ", "write ", "total ", "rays: 576 primary", "Mray/s",
                           "samples: 0 not finite, 0 too bright", "MiB"}) {
    EXPECT_THAT(run.err, HasSubstr(part));
  }
  EXPECT_THAT(render({}).err, IsEmpty());
}

TEST_F(Statistics, UnwritableFileFailsBeforeThePicture) {
  const ProgramRun run = render({"--stats", "json:" + path("no/such.json")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err,
              HasSubstr("cannot write '" + path("no/such.json") + "': No such file or directory"));
  EXPECT_THAT(files(), testing::ElementsAre("scene.toml"));
}

TEST_F(Statistics, FullFileFailsAfterThePicture) {
  std::filesystem::create_symlink("/dev/full", path("full"));
  const ProgramRun run = render({"--stats", "json:" + path("full")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("No space left"));
  EXPECT_THAT(files(), testing::ElementsAre("full", "scene.toml", "x.ppm"));
}

TEST_F(Statistics, NeverReplaceThePictureOrTheScene) {
  const std::string scene = small_scene();
  const std::string text = read("scene.toml");
  for (const char* other : {"./x.ppm", "../x.ppm", "scene.toml", "./scene.toml"}) {
    std::string file = path(other);
    if (std::string(other).starts_with("..")) {  // by way of the folder's own name
      file =
          path("../" + std::filesystem::path(scene).parent_path().filename().string() + "/x.ppm");
    }
    const ProgramRun run =
        boule_run({"render", scene, "-o", path("x.ppm"), "--stats", "json:" + file});
    EXPECT_EQ(run.exit_code, 2) << file;
    EXPECT_THAT(run.err, HasSubstr("statistics would replace")) << file;
    EXPECT_EQ(read("scene.toml"), text);
    EXPECT_THAT(files(), testing::ElementsAre("scene.toml"));
  }
}

}  // namespace
}  // namespace boule::test
