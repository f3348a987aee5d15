// Rendering from the command line: what an option must change, and what it must not.
#include "simd/dispatch/dispatch.h"
#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Render : public ProgramTest {
 protected:
  /// Renders the small scene with these options to a picture; its bytes.
  std::string picture(std::vector<std::string> options, const std::string& name = "out.exr") {
    std::vector<std::string> arguments = {"render", small_scene(), "-o", path(name), "-q"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = boule_run(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.out, IsEmpty());
    EXPECT_THAT(run.err, IsEmpty());
    return read(name);
  }
};

TEST_F(Render, WritesThePictureAndTellsStandardError) {
  const ProgramRun run = boule_run({"render", small_scene(), "-o", path("out.png")});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, HasSubstr("32 x 18 pixels"));
  EXPECT_EQ(read("out.png").substr(0, 4), "\x89PNG");
  EXPECT_THAT(files(), testing::ElementsAre("out.png", "scene.toml"));
}

TEST_F(Render, EveryInstructionSetGivesTheSameFile) {
  const std::string expected = picture({"--isa", "scalar"});
  for (const IsaInfo& info : list_isas()) {
    if (!info.supported) continue;
    EXPECT_EQ(picture({"--isa", std::string(info.name)}), expected) << info.name;
  }
}

TEST_F(Render, ThreadsTilesAndOrderNeverShow) {
  const std::string expected = picture({"--spp", "3"});
  for (const char* threads : {"0", "1", "2", "7"}) {
    EXPECT_EQ(picture({"--spp", "3", "-t", threads}), expected);
  }
  for (const char* tile : {"1", "3", "8", "64"}) {
    EXPECT_EQ(picture({"--spp", "3", "--tile", tile}), expected);
  }
  for (const char* order : {"rows", "tiles", "progressive", "frameless"}) {
    EXPECT_EQ(picture({"--spp", "3", "--order", order}), expected);
  }
}

TEST_F(Render, ReferenceAndRobustAgree) {
  // The file's header names the solver: compare the pixels, as PNG without such a header.
  const std::string robust = picture({"--solver", "robust"}, "a.ppm");
  EXPECT_EQ(picture({"--solver", "reference"}, "b.ppm"), robust);
  EXPECT_EQ(picture({"--solver", "fast"}, "c.ppm").size(), robust.size());
}

TEST_F(Render, WhittedIsTheMethod) {
  EXPECT_EQ(picture({"--method", "whitted"}, "a.ppm"), picture({}, "b.ppm"));
  EXPECT_NE(picture({"--method", "path"}, "p.ppm"), picture({}, "b.ppm"));
  EXPECT_EQ(picture({"--method", "path", "--spp", "3", "-t", "3"}, "p.ppm"),
            picture({"--method", "path", "--spp", "3", "-t", "1", "--tile", "5"}, "q.ppm"));
}

/// A picture of ours as another's surroundings: seen by both methods, turned by its rotation.
TEST_F(Render, AnEnvironmentImageIsSeenAllAround) {
  picture({"--size", "64x32"}, "around.exr");
  const auto seen = [&](const std::string& keys, const std::string& method) {
    const std::string scene = write("around.toml",
                                    "schema = 1\n[[sphere]]\n[background]\n"
                                    "type = \"environment\"\nfile = \"around.exr\"\n" +
                                        keys);
    const ProgramRun run = boule_run(
        {"render", scene, "-o", path("e.ppm"), "--size", "24x16", "--method", method, "-q"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read("e.ppm");
  };
  for (const char* method : {"whitted", "path"}) {
    const std::string plain = seen("", method);
    EXPECT_NE(seen("rotation = 90\n", method), plain);
    EXPECT_EQ(seen("rotation = 360\n", method), seen("rotation = 0\n", method));
  }
}

TEST_F(Render, SizeSppSeedDepthAndExposureShow) {
  const std::string plain = picture({}, "a.ppm");
  EXPECT_EQ(plain.substr(0, 12), "P6\n32 18\n255");
  EXPECT_EQ(picture({"--size", "20x40"}, "b.ppm").substr(0, 8), "P6\n20 40");
  const std::string sampled = picture({"--spp", "4"}, "c.ppm");
  EXPECT_NE(sampled, plain);
  EXPECT_NE(picture({"--spp", "4", "--seed", "1"}, "d.ppm"), sampled);
  EXPECT_EQ(picture({"--seed", "1"}, "e.ppm"), plain);  // one sample is the pixel's centre
  EXPECT_NE(picture({"--max-depth", "0"}, "f.ppm"), plain);
  EXPECT_NE(picture({"--exposure", "1"}, "g.ppm"), plain);
}

TEST_F(Render, CompressionChangesTheFileNotThePicture) {
  const std::string none = picture({"--compression", "none"});
  const std::string rle = picture({"--compression", "rle"});
  const std::string zip = picture({"--compression", "zip"});
  EXPECT_NE(none, zip);
  EXPECT_NE(rle, zip);
  EXPECT_LT(zip.size(), none.size());
  EXPECT_EQ(picture({}), zip);
}

TEST_F(Render, CropMatchesThatPartOfTheFrame) {
  const std::string frame = picture({}, "frame.ppm");
  const std::string crop = picture({"--crop", "5,3,17,11"}, "crop.ppm");
  const std::string header = "P6\n12 8\n255\n";
  ASSERT_EQ(crop.substr(0, header.size()), header);
  const std::size_t frame_header = std::string("P6\n32 18\n255\n").size();
  for (std::size_t y = 0; y < 8; ++y) {
    EXPECT_EQ(crop.substr(header.size() + y * 36, 36),
              frame.substr(frame_header + ((y + 3) * 32 + 5) * 3, 36))
        << y;
  }
}

TEST_F(Render, NffPolygonIsAPlaneByDefault) {
  const std::string scene = write("s.nff",
                                  "b 0.1 0.2 0.3\nv\nfrom 0 -5 2\nat 0 0 0\nup 0 0 1\nangle 45\n"
                                  "hither 1\nresolution 16 16\nl 0 -5 5\nf 1 0 0 1 0 0 0 1\n"
                                  "p 3\n-1 -1 0\n1 -1 0\n0 1 0\ns 0 0 1 0.5\n");
  const auto render = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments = {"render", scene, "-o", path("n.ppm")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return boule_run(arguments);
  };
  const ProgramRun plane = render({});
  EXPECT_EQ(plane.exit_code, 0);
  EXPECT_THAT(plane.err, HasSubstr("warning"));
  const std::string with_plane = read("n.ppm");
  EXPECT_THAT(render({"-q"}).err, IsEmpty());
  EXPECT_EQ(read("n.ppm"), with_plane);
  const ProgramRun skip = render({"--polygons", "skip"});
  EXPECT_EQ(skip.exit_code, 0);
  EXPECT_NE(read("n.ppm"), with_plane);
  const ProgramRun error = render({"--polygons", "error"});
  EXPECT_EQ(error.exit_code, 3);
  EXPECT_THAT(error.err, HasSubstr("s.nff:11:"));
}

TEST_F(Render, AnOldFileIsReplacedWhole) {
  write("out.png", std::string(100000, 'x'));
  const std::string fresh = picture({}, "fresh.png");
  EXPECT_EQ(picture({}, "out.png"), fresh);
}

TEST_F(Render, TheShippedSceneRenders) {
  const ProgramRun run = boule_run({"render", std::string(BOULE_SCENES) + "/first_light.toml", "-o",
                                    path("f.png"), "--size", "64x36", "--spp", "1"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

}  // namespace
}  // namespace boule::test
