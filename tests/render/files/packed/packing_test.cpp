// boule pack, and the other commands with packed scenes.
#include <algorithm>

#include "tests/render/apps/cli/program.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Packing : public ProgramTest {
 protected:
  /// Runs it; the test fails unless it ends well.
  void run(const std::vector<std::string>& words) const {
    const ProgramRun run = boule_run(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
  }
  void pack(const std::vector<std::string>& inputs, const std::string& output,
            const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"pack", "-q", "-o", path(output)};
    words.insert(words.end(), inputs.begin(), inputs.end());
    words.insert(words.end(), more.begin(), more.end());
    run(words);
  }
  std::string picture(const std::string& scene, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"render",           scene, "-q", "--aov", "id,depth", "-o",
                                      path("picture.exr")};
    words.insert(words.end(), more.begin(), more.end());
    run(words);
    return read("picture.exr");
  }
  ProgramRun refused(const std::vector<std::string>& words, int code) const {
    const ProgramRun run = boule_run(words);
    EXPECT_EQ(run.exit_code, code) << run.err;
    const int lines =
        code == 2 && run.err.starts_with("boule: error: --memory") ? 2 : 1;  // and the help
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), lines) << run.err;
    return run;
  }
  /// Spheres alone: rows first .. end - 1 of an endless file.
  std::string spheres(const std::string& name, int first, int end) const {
    std::vector<Sphere> all;
    for (int i = first; i < end; ++i) {
      const auto x = static_cast<float>(i % 40), y = static_cast<float>(i / 40 % 40);
      all.push_back({{x, y, static_cast<float>(i % 7)}, 0.3F + 0.01F * static_cast<float>(i % 5)});
    }
    write(name, sphere_file(all));
    return path(name);
  }
};

TEST_F(Packing, ThePictureIsThatOfTheScene) {
  const std::string scene = small_scene();
  pack({scene}, "packed.boule");
  EXPECT_EQ(files(), (std::vector<std::string>{"packed.boule", "scene.toml"}));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--method", "path", "--spp", "4"}, {"--size", "20x30"}}) {
    EXPECT_EQ(picture(path("packed.boule"), more), picture(scene, more));
  }
  EXPECT_EQ(picture(path("packed.boule"), {"--trust"}), picture(scene));
}

TEST_F(Packing, TakesPlainSpheresFromFilesOrPipes) {
  const std::string all = spheres("all.npy", 0, 3000), first = spheres("a.npy", 0, 1200),
                    second = spheres("b.npy", 1200, 3000);
  const std::string wanted = picture(all, {"--size", "40x30"});
  pack({all}, "all.boule");
  EXPECT_EQ(picture(path("all.boule"), {"--size", "40x30"}), wanted);
  pack({first, second}, "parts.boule", {"--memory", "16M", "-t", "3"});
  EXPECT_EQ(read("parts.boule"), read("all.boule"));
  const ProgramRun piped = run_program(
      "/bin/sh",
      {{"-c", "cat '" + all + "' | '" BOULE_PROGRAM "' pack -q - -o '" + path("piped.boule") + "'"},
       {}});
  EXPECT_EQ(piped.exit_code, 0) << piped.err;
  EXPECT_EQ(read("piped.boule"), read("all.boule"));
}

TEST_F(Packing, ASceneFileGivesItAnotherCamera) {
  pack({small_scene()}, "packed.boule");
  const std::string rest =
      "[camera]\neye = [3.0, 2.0, 4.0]\nlook_at = [0.0, 0.5, 0.0]\n[image]\nsize = [24, 20]\n";
  const std::string outer =
      write("outer.toml", "schema = 1\n[[packed]]\nfile = \"packed.boule\"\n" + rest);
  const std::string wanted =
      picture(small_scene(),
              {"--size", "24x20", "--camera", "eye = [3.0, 2.0, 4.0], look_at = [0.0, 0.5, 0.0]"});
  EXPECT_EQ(picture(outer), wanted);
}

TEST_F(Packing, ContradictingSceneFileIsRefused) {
  pack({small_scene()}, "packed.boule");
  const auto message = [&](const std::string& rest) {
    const std::string file =
        write("outer.toml", "schema = 1\n[[packed]]\nfile = \"packed.boule\"\n" + rest);
    return refused({"render", file, "-o", path("p.png")}, 3).err;
  };
  const std::string others = "a scene has no other spheres beside packed ones";
  EXPECT_THAT(message("[[sphere]]\ncenter = [0.0, 0.0, 0.0]\n"),
              HasSubstr(":4:1: error: " + others));
  EXPECT_THAT(message("[group.a]\n[[group.a.sphere]]\n[[instance]]\ngroup = \"a\"\n"),
              HasSubstr(others));
  EXPECT_THAT(message("[[packed]]\nfile = \"packed.boule\"\n"),
              HasSubstr("a scene has one packed file at most"));
  EXPECT_THAT(message("[material.shiny]\n"),
              HasSubstr("the packed scene has a material of this name already"));
  const std::string missing = write("m.toml", "schema = 1\n[[packed]]\nfile = \"none.boule\"\n");
  EXPECT_THAT(refused({"render", missing, "-o", path("p.png")}, 3).err,
              HasSubstr("m.toml:3:8: error: 'none.boule': cannot read it"));
}

TEST_F(Packing, InfoTellsWhatIsInside) {
  pack({small_scene()}, "packed.boule");
  const ProgramRun whole = boule_run({"info", small_scene()}),
                   packed = boule_run({"info", "--verify", path("packed.boule")});
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  const auto line = [](const std::string& text, const std::string& key) {
    const std::size_t at = text.find(key + ": ");
    return at == std::string::npos ? "none" : text.substr(at, text.find('\n', at) - at);
  };
  for (const char* const key : {"hash", "spheres", "planes", "bounds", "camera", "size"})
    EXPECT_EQ(line(packed.out, key), line(whole.out, key));
  EXPECT_THAT(packed.out, HasSubstr("chunks: 1\nsections: "));
  EXPECT_THAT(packed.out, HasSubstr("verified: true"));
}

TEST_F(Packing, TraceFindsTheSameHits) {
  pack({spheres("all.npy", 0, 3000)}, "all.boule");
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) rays.push_back({{0.2 * i, 10, -20}, {0, 0, 1}});
  write("rays.npy", ray_file(rays));
  run({"trace", path("all.npy"), "-q", "--rays", path("rays.npy"), "-o", path("a.npy")});
  run({"trace", path("all.boule"), "-q", "--rays", path("rays.npy"), "-o", path("b.npy")});
  EXPECT_EQ(read("a.npy"), read("b.npy"));
}

TEST_F(Packing, ThatFailsLeavesNothing) {
  const std::string broken = write("broken.toml", "schema = 1\n[[sphere]]\nradius = -1\n");
  EXPECT_THAT(refused({"pack", broken, "-o", path("p.boule")}, 3).err, HasSubstr("broken.toml:3"));
  const std::string npy = spheres("cut.npy", 0, 100);
  const std::string bytes = read("cut.npy");
  write("cut.npy", bytes.substr(0, bytes.size() - 4));
  EXPECT_THAT(refused({"pack", npy, "-o", path("p.boule")}, 3).err,
              HasSubstr("cut.npy: error: declares 100 rows"));
  std::string nan = bytes;
  nan.replace(nan.size() - 4, 4, "\xff\xff\xff\x7f");
  write("cut.npy", nan);
  EXPECT_THAT(refused({"pack", npy, "-o", path("p.boule")}, 3).err,
              HasSubstr("cut.npy: error: row 99: radius"));
  const ProgramRun piped =
      run_program("/bin/sh", {{"-c", "head -c 900 '" + npy + "' | '" BOULE_PROGRAM "' pack - -o '" +
                                         path("p.boule") + "'"},
                              {}});
  EXPECT_EQ(piped.exit_code, 3);
  EXPECT_THAT(piped.err, HasSubstr("standard input: error: declares 100 rows, but ends after 48"));
  EXPECT_EQ(files(), (std::vector<std::string>{"broken.toml", "cut.npy"}));
}

TEST_F(Packing, WrongUseIsTold) {
  const std::string scene = small_scene();
  EXPECT_THAT(refused({"pack", scene, "-o", path("p.png")}, 2).err, HasSubstr("--output"));
  EXPECT_THAT(refused({"pack", scene, scene, "-o", path("p.boule")}, 2).err,
              HasSubstr("more than one are packed only where all are .npy files"));
  EXPECT_THAT(refused({"pack", scene, "-o", path("p.boule"), "--memory", "3M"}, 2).err,
              HasSubstr("16M or more"));
  pack({scene}, "packed.boule");
  EXPECT_THAT(refused({"pack", path("packed.boule"), "-o", path("p.boule")}, 3).err,
              HasSubstr("its spheres are packed already"));
  EXPECT_THAT(refused({"pack", path("packed.boule"), "-o", path("packed.boule")}, 2).err,
              HasSubstr("would replace"));
  EXPECT_THAT(refused({"info", scene, "--verify"}, 2).err, HasSubstr("is of packed scenes"));
}

TEST_F(Packing, FilesThatAreNoneAreRefused) {
  pack({small_scene()}, "packed.boule");
  const std::string bytes = read("packed.boule");
  for (const std::string& wrong :
       {std::string(), std::string("schema = 1"), bytes.substr(0, 5000), std::string(9000, 'x')}) {
    const std::string file = write("wrong.boule", wrong);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"render", file, "-o", path("p.png")}, {"info", file}}) {
      EXPECT_THAT(refused(words, 3).err, StartsWith(file + ": error: "));
    }
  }
}

}  // namespace
}  // namespace boule::test
