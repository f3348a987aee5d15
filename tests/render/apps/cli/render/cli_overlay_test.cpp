// What is drawn on finished pictures, as the program writes them.
#include <cstddef>
#include <filesystem>

#include "tests/render/apps/cli/particles/particles_fixture.h"

namespace boule::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int width = 320, height = 240;

class Overlays : public ParticlesTest {
 protected:
  ProgramRun draw(const std::string& file, const std::string& picture,
                  const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"render", file,      "-o",      path(picture),
                                          "--size", "320x240", "--quick", "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ProgramRun run = boule_run(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run;
  }
  /// The differing pixels within a part of two PPM files of the size above.
  int differing(const std::string& a, const std::string& b, int x0, int y0, int x1, int y1) const {
    const std::string first = read(a), second = read(b);
    const std::size_t pixels = std::size_t{3} * width * height;
    EXPECT_EQ(first.size(), second.size());
    EXPECT_GT(first.size(), pixels);
    const std::size_t head = first.size() - pixels;
    int count = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const std::size_t at = head + 3 * static_cast<std::size_t>(y * width + x);
        count += first.compare(at, 3, second, at, 3) == 0 ? 0 : 1;
      }
    }
    return count;
  }
};

TEST_F(Overlays, ChangeTheirCornersOnly) {
  const std::string file = water();
  const std::vector<std::string> wide{"--margin", "0.3"};  // so that no camera makes room
  draw(file, "plain.ppm", wide);
  const auto all = [&](const std::string& name) {
    return differing("plain.ppm", name, 0, 0, width, height);
  };
  draw(file, "legend.ppm", {"--overlay", "legend", "--margin", "0.3"});
  EXPECT_GT(all("legend.ppm"), 100);
  EXPECT_EQ(all("legend.ppm"), differing("plain.ppm", "legend.ppm", 260, 0, width, 80));
  draw(file, "scale.ppm", {"--overlay", "scale", "--margin", "0.3"});
  EXPECT_GT(all("scale.ppm"), 100);
  EXPECT_EQ(all("scale.ppm"), differing("plain.ppm", "scale.ppm", 160, 190, width, height));
  draw(file, "axes.ppm", {"--overlay", "axes", "--margin", "0.3"});
  EXPECT_GT(all("axes.ppm"), 100);
  EXPECT_EQ(all("axes.ppm"), differing("plain.ppm", "axes.ppm", 0, 140, 100, height));
}

TEST_F(Overlays, HaveTheSameBitsForAnyThreads) {
  const std::string file = water();
  draw(file, "a.png", {"--overlay", "legend,scale,axes", "-t", "1", "--isa", "scalar"});
  draw(file, "b.png", {"--overlay", "legend,scale,axes", "-t", "2"});
  EXPECT_TRUE(read("a.png") == read("b.png"));
}

TEST_F(Overlays, TellTheFrameOfASeries) {
  const std::string file = growing(2);
  draw(file, "plain.#.ppm", {"--frames", "0-1"});
  draw(file, "time.#.ppm", {"--frames", "0-1", "--overlay", "time"});
  for (const char* number : {"0", "1"}) {
    const std::string plain = std::string("plain.") + number + ".ppm";
    const std::string time = std::string("time.") + number + ".ppm";
    EXPECT_GT(differing(plain, time, 0, 0, 100, 40), 50);
    EXPECT_EQ(differing(plain, time, 0, 40, width, height), 0);
  }
}

TEST_F(Overlays, OfPagesAreTextAndVectors) {
  const std::string file = water();
  draw(file, "a.svg", {"--overlay", "legend,scale", "--width", "85mm"});
  EXPECT_THAT(read("a.svg"), AllOf(StartsWith("<?xml"), HasSubstr(">O</text>"),
                                   HasSubstr("width=\"240."), HasSubstr("data:image/png;base64,")));
  draw(file, "plain.svg", {});
  EXPECT_THAT(read("plain.svg"), Not(HasSubstr("<text")));
  draw(file, "a.pdf", {"--overlay", "legend,scale", "--width", "85mm"});
  EXPECT_THAT(read("a.pdf"), AllOf(StartsWith("%PDF-"), HasSubstr("/ToUnicode")));
  draw(file, "b.pdf", {"--overlay", "legend,scale", "--width", "85mm"});
  EXPECT_TRUE(read("a.pdf") == read("b.pdf"));
}

TEST_F(Overlays, ScenesAskForThem) {
  const std::string file = water();
  draw(file, "option.ppm", {"--overlay", "axes,scale"});
  scene_of(file, {"--quick"});
  std::string scene = read("made.toml");
  scene.replace(scene.find("[image]\n"), 8, "[image]\noverlay = [\"axes\", \"scale\"]\n");
  const std::string made = write("overlay.toml", scene);
  const auto render = [&](const std::string& picture, std::vector<std::string> options) {
    options.insert(options.begin(), {"render", made, "-o", path(picture), "--size", "320x240"});
    const ProgramRun run = boule_run(options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.err;
  };
  EXPECT_THAT(render("key.ppm", {}), HasSubstr("the scale bar is right at"));
  EXPECT_TRUE(read("key.ppm") == read("option.ppm"));
  render("none.ppm", {"--overlay", "none"});
  draw(file, "plain.ppm", {});
  EXPECT_TRUE(read("none.ppm") == read("plain.ppm"));
  EXPECT_THAT(render("key.exr", {}), HasSubstr("nothing is drawn on colours before tone mapping"));
}

TEST_F(Overlays, LegendsHaveRoomBesideParticles) {
  const std::string file = water();
  const std::vector<std::string> wide{"--view", "-z", "--up", "y", "--scale", "3"};
  std::vector<std::string> options = wide;
  options.insert(options.end(), {"--overlay", "legend"});
  draw(file, "legend.ppm", options);
  options.back() = "none";
  draw(file, "none.ppm", options);
  EXPECT_GT(differing("none.ppm", "legend.ppm", 0, 0, 160, height), 100);  // it stands more left
  // Nothing is below the legend's colours at the right edge.
  const std::string picture = read("legend.ppm");
  const std::size_t head = picture.size() - std::size_t{3} * width * height;
  for (int y = 80; y < height; ++y) {
    const std::size_t at = head + 3 * static_cast<std::size_t>(y * width + width - 20);
    EXPECT_EQ(picture.substr(at, 3), "\xff\xff\xff") << y;
  }
}

TEST_F(Overlays, LabelsAreOfWhatIsSeen) {
  // The second is behind the first.
  const std::string file =
      write("three.xyz", "3\nProperties=species:S:1:pos:R:3\nC 0 0 0\nN 0 0 -9\nO 9 0 0\n");
  const auto texts = [&](const std::vector<std::string>& options) {
    std::vector<std::string> all{"--view", "-z", "--up", "y", "--ortho", "--radius", "1"};
    all.insert(all.end(), options.begin(), options.end());
    draw(file, "a.svg", all);
    return read("a.svg");
  };
  EXPECT_THAT(texts({}), Not(HasSubstr("<text")));
  EXPECT_THAT(texts({"--labels", "x >= 0"}),
              AllOf(HasSubstr(">C</text>"), HasSubstr(">O</text>"), Not(HasSubstr(">N</text>"))));
  EXPECT_THAT(texts({"--labels", "species == 'O'", "--label-text", "x,species"}),
              AllOf(HasSubstr(">9 O</text>"), Not(HasSubstr(">C</text>"))));
  EXPECT_THAT(texts({"--labels", "x >= 0", "--select", "species != 'C'"}), HasSubstr(">N</text>"));
}

TEST_F(Overlays, AreRefusedWhereTheyCannotBe) {
  const std::string file = water();
  const auto refused = [&](const std::string& picture, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"render", file, "-o", path(picture)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return refused_run(arguments, 2).err;
  };
  EXPECT_THAT(refused("a.png", {"--overlay", "lgend"}), HasSubstr("did you mean 'legend'?"));
  EXPECT_THAT(refused("a.exr", {"--overlay", "scale"}), HasSubstr("before tone mapping"));
  EXPECT_THAT(refused("a.film", {"--overlay", "scale", "--shard", "1/2"}),
              HasSubstr("finished pictures"));
  EXPECT_THAT(refused("a.exr", {"--labels", "x > 0"}),
              AllOf(HasSubstr("--labels"), HasSubstr("before tone mapping")));
  EXPECT_THAT(refused("a.svg", {"--skip-existing"}), HasSubstr("cannot be read back"));
}

TEST_F(Overlays, WithoutTheModuleNameThePackage) {
  const std::string file = water();
  std::filesystem::copy_file(BOULE_PROGRAM, path("boule"));
  const ProgramRun plain =
      run_program(path("boule"), {{"render", file, "-o", path("a.ppm"), "--quick", "-q"}, {}});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  const ProgramRun run = run_program(
      path("boule"), {{"render", file, "-o", path("b.ppm"), "--quick", "--overlay", "scale"}, {}});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("boule_overlay.so is not in"), HasSubstr("libpangocairo-1.0-0")));
  EXPECT_FALSE(std::filesystem::exists(path("b.ppm")));
}

}  // namespace
}  // namespace boule::test
