// What goes wrong: one clear error, the right exit code, nothing left behind.
#include "tests/render/apps/cli/program.h"

namespace boule::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Errors : public ProgramTest {
 protected:
  /// Runs `boule render` and checks what holds for every refusal.
  ProgramRun refused(const std::vector<std::string>& arguments, int code,
                     const std::vector<std::string>& environment = {}) {
    std::vector<std::string> all = {"render"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return refused_run(all, code, environment);
  }
};

TEST(Usage, NothingOrNonsenseIsWrongUsage) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"rander"},
                                             {"render"},
                                             {"render", "a.toml"},
                                             {"render", "-o", "x.png"},
                                             {"info"},
                                             {"info", "a.toml", "--yaml"},
                                             {"isa", "--yaml"},
                                             {"isa", "more"},
                                             {"--nonsense"}}) {
    const ProgramRun run = boule_run(arguments);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.out, IsEmpty());
    EXPECT_THAT(run.err, StartsWith("boule: error: "));
  }
}

const std::pair<const char*, const char*> bad_values[] = {
    {"--size", "640"},
    {"--size", "640x"},
    {"--size", "0x480"},
    {"--size", "640x65536"},
    {"--size", "-1x5"},
    {"--size", "640x480x2"},
    {"--size", "1e3x5"},
    {"--spp", "0"},
    {"--spp", "many"},
    {"--spp", "1.5"},
    {"--spp", "+1"},
    {"--spp", "0x10"},
    {"--spp", "2147483648"},
    {"--filter", "gauss"},
    {"--filter", ""},
    {"--seed", "18446744073709551616"},
    {"--seed", "-1"},
    {"--seed", "x"},
    {"--max-depth", "-1"},
    {"--max-depth", "deep"},
    {"--isa", "sse9"},
    {"--isa", ""},
    {"--solver", "exact"},
    {"-t", "-1"},
    {"-t", "100000"},
    {"--tile", "0"},
    {"--tile", "5000"},
    {"--compression", "lzw"},
    {"--polygons", "cut"},
    {"--order", "random"},
    {"--crop", "1,2,3"},
    {"--crop", "4,0,4,9"},
    {"--crop", "-1,0,4,9"},
    {"--crop", "0,0,33,18"},
    {"--exposure", "bright"},
    {"--exposure", "nan"},
    {"--exposure", "101"},
    {"--nonsense", "1"},
    {"--method", "rays"},
    {"--progress", "dots"},
    {"--progress", ""},
    {"--stats", "yaml"},
    {"--stats", "json:"},
    {"--stats", "text:x"},
    {"--aov", ""},
    {"--aov", "depth,"},
    {"--aov", "depth,depth"},
    {"--aov", "height"},
    {"--aov", "depth"}};  // depth: not into a .png

TEST_F(Errors, ABadOptionValueIsWrongUsage) {
  const std::string scene = small_scene();
  std::vector<std::pair<std::string, std::string>> options(std::begin(bad_values),
                                                           std::end(bad_values));
  options.emplace_back("--stats", "json:" + path("out.png"));
  for (const auto& [option, value] : options) {
    SCOPED_TRACE(option + " " + value);
    const ProgramRun run = refused({scene, "-o", path("out.png"), option + "=" + value}, 2);
    EXPECT_THAT(run.err, StartsWith("boule: error: "));
  }
}

TEST_F(Errors, ExtensionIsCheckedBeforeTheScene) {
  for (const char* name : {"picture", "picture.", "picture.xyz", "png", ".png"}) {
    SCOPED_TRACE(name);
    refused({path("missing.toml"), "-o", path(name)}, 2);
  }
}

TEST_F(Errors, UnknownIsaInTheEnvironmentIsRefused) {
  const ProgramRun run = refused({small_scene(), "-o", path("x.png")}, 2, {"BOULE_ISA=sse9"});
  EXPECT_THAT(run.err, HasSubstr("BOULE_ISA: 'sse9'"));
  EXPECT_EQ(boule_run({"isa"}, {"BOULE_ISA=sse9"}).exit_code, 2);
}

TEST_F(Errors, AovsNeedAFormatThatHoldsThem) {
  for (const char* name : {"x.png", "x.jpg", "x.hdr", "x.tif", "x.ppm"}) {
    const ProgramRun run = refused({path("missing.toml"), "-o", path(name), "--aov", "id"}, 2);
    EXPECT_THAT(run.err, HasSubstr("(key '--aov')"));
  }
}

TEST_F(Errors, SkippingNeedsMarkedPartialPictures) {
  for (const char* name : {"x.ppm", "x.bmp", "x.hdr", "x.webp"}) {
    const ProgramRun run =
        refused({path("missing.toml"), "-o", path(name), "--partial", "--skip-existing"}, 2);
    EXPECT_THAT(run.err, HasSubstr("(key '--skip-existing')"));
  }
}

TEST_F(Errors, OutputNeverReplacesAnInput) {
  const std::string map = path("map.exr"), link = path("link.exr"), sky = path("sky.png");
  ASSERT_EQ(boule_run({"render", small_scene(), "-o", map, "-q"}).exit_code, 0);
  ASSERT_EQ(boule_run({"render", small_scene(), "-o", sky, "-q"}).exit_code, 0);
  std::filesystem::create_hard_link(map, link);
  const std::string scene = write("map.toml",
                                  "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
                                  "[camera.distortion]\nfile = \"map.exr\"\n"
                                  "[background]\ntype = \"environment\"\nfile = \"./sky.png\"\n");
  for (const std::string& output : {map, link, sky}) {
    const ProgramRun run = refused({scene, "-o", output, "-q"}, 2);
    EXPECT_THAT(run.err, HasSubstr("the picture would replace '"));
    EXPECT_THAT(run.err, HasSubstr("(key '--output')"));
    refused({scene, "-o", path("x.png"), "-q", "--stats", "json:" + output}, 2);
  }
  std::filesystem::create_symlink("scene.toml", path("scene.png"));
  refused({small_scene(), "-o", path("scene.png"), "-q"}, 2);
}

TEST_F(Errors, ConflictsNameTheOptionsAsGiven) {
  const auto error = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {small_scene(), "-o", path("x.ppm"), "-q"});
    return refused(options, 2).err;
  };
  EXPECT_THAT(error({"--crop", "0,0,5000,5000"}), HasSubstr("(key '--crop')"));
  EXPECT_THAT(error({"--noise", "0.01", "--spp", "8"}), HasSubstr("(key '--spp')"));
  EXPECT_THAT(error({"--aov", "noise"}), HasSubstr("(key '--aov')"));
  EXPECT_THAT(error({"--aa", "8", "--noise", "0.1"}), HasSubstr("(key '--aa')"));
  EXPECT_THAT(error({"--aa", "8", "--method", "path"}), HasSubstr("(key '--aa')"));
}

TEST_F(Errors, SkippingNeedsMarkedCrops) {
  for (const char* name : {"x.png", "x.tif"}) {
    const ProgramRun run = refused(
        {path("missing.toml"), "-o", path(name), "--crop", "0,0,4,4", "--skip-existing"}, 2);
    EXPECT_THAT(run.err, HasSubstr("(key '--skip-existing')"));
  }
}

TEST_F(Errors, TheSourceDateIsParsedStrictly) {
  for (const char* date :
       {"", "-1", "1.5", "1e9", " 1", "1 ", "0x1", "now", "253402300800", "99999999999999999999"}) {
    const ProgramRun run = refused({small_scene(), "-o", path("x.png")}, 2,
                                   {std::string("SOURCE_DATE_EPOCH=") + date});
    EXPECT_THAT(run.err, HasSubstr("SOURCE_DATE_EPOCH: '" + std::string(date) + "'"));
  }
}

TEST_F(Errors, QuietAndVerboseExcludeEachOther) {
  refused({small_scene(), "-o", path("x.png"), "-q", "-v"}, 2);
}

TEST_F(Errors, UnknownMethodInASceneIsRefused) {
  refused({write("path.toml", "schema = 1\n[render]\nmethod = \"paths\"\n"), "-o", path("x.png")},
          3);
}

TEST_F(Errors, MissingSceneGivesTheSystemsReason) {
  const ProgramRun run = refused({path("none.toml"), "-o", path("x.png")}, 3);
  EXPECT_THAT(run.err, HasSubstr("none.toml"));
  EXPECT_THAT(run.err, HasSubstr("No such file or directory"));
}

TEST_F(Errors, BadSceneNamesItsPlaceAndKey) {
  const std::string scene = write("bad.toml",
                                  "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n"
                                  "fov = 190\n");
  const ProgramRun run = refused({scene, "-o", path("x.png")}, 3);
  EXPECT_THAT(run.err, StartsWith(scene + ":5:"));
  EXPECT_THAT(run.err, HasSubstr("(key 'camera.fov')"));
}

/// Once for each table and each kind of thing that has keys; the readers' own tests have every key.
TEST_F(Errors, EveryTableNamesItsPlaceAndKey) {
  const std::string camera = "schema = 1\n[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n";
  const std::string background = "schema = 1\n[background]\ntype = \"environment\"\n";
  const std::string instance = "schema = 1\n[[group.a.sphere]]\n[[instance]]\ngroup = \"a\"\n";
  write("text.exr", "no picture");
  struct Bad {
    std::string text, place, key;
  };
  for (const auto& [text, place, key] : std::vector<Bad>{
           {"schema = 1\n[image]\nfilter = \"bx\"\n", "3:10", "image.filter"},
           {"schema = 1\n[render]\nmethod = \"paths\"\n", "3:10", "render.method"},
           {camera + "type = \"fisheye\"\nfov = 361\n", "6:7", "camera.fov"},
           {camera + "type = \"thin_lens\"\naperture = -1\n", "6:12", "camera.aperture"},
           {camera + "type = \"thin_lens\"\naperture = 1\nfocus = 0\n", "7:9", "camera.focus"},
           {camera + "type = \"lens\"\nfile = \"none.lens\"\n", "6:8", "camera.file"},
           {camera + "[camera.distortion]\nfile = \"text.exr\"\n", "6:8", "camera.distortion.file"},
           {camera + "[[camera.key]]\nframe = -1\nfov = 9\n", "6:9", "camera.key[0].frame"},
           {background + "file = \"text.exr\"\n", "4:8", "background.file"},
           {background + "file = \"text.exr\"\nrotation = \"left\"\n", "5:12",
            "background.rotation"},
           {"schema = 1\n[[light]]\ntype = \"sphere\"\nradius = 0\n", "4:10", "light[0].radius"},
           {instance + "scale = -1\n", "5:9", "instance[0].scale"},
           {instance + "[[group.a.instance]]\ngroup = \"a\"\n", "6:9",
            "group.a.instance[0].group"}}) {
    SCOPED_TRACE(key);
    const std::string scene = write("bad.toml", text);
    const ProgramRun run = refused({scene, "-o", path("x.png")}, 3);
    EXPECT_THAT(run.err, StartsWith(scene + ":" + place + ": error: "));
    EXPECT_THAT(run.err, HasSubstr("(key '" + key + "')"));
  }
}

TEST_F(Errors, AnOldPictureSurvivesABadScene) {
  write("x.png", "old");
  refused({write("bad.toml", "schema = 2\n"), "-o", path("x.png")}, 3);
  EXPECT_EQ(read("x.png"), "old");
}

TEST_F(Errors, UnwritableOutputGivesTheSystemsReason) {
  const std::string scene = small_scene();
  const ProgramRun missing = refused({scene, "-o", path("no/such/x.png"), "-q"}, 1);
  EXPECT_THAT(missing.err, HasSubstr("cannot write '"));
  EXPECT_THAT(missing.err, HasSubstr("No such file or directory"));
  std::filesystem::create_directory(path("folder.png"));
  const ProgramRun folder = refused({scene, "-o", path("folder.png"), "-q"}, 1);
  EXPECT_THAT(folder.err, HasSubstr("Is a directory"));
}

TEST_F(Errors, FullTargetIsAnError) {
  std::filesystem::create_symlink("/dev/full", path("full.png"));
  const ProgramRun run = refused({small_scene(), "-o", path("full.png"), "-q"}, 1);
  EXPECT_THAT(run.err, HasSubstr("No space left on device"));
}

TEST_F(Errors, QuotedInputIsCutAndEscaped) {
  const ProgramRun run =
      refused({small_scene(), "-o", path("x.png"), "--solver=" + std::string(100, 'a')}, 2);
  EXPECT_THAT(run.err, HasSubstr(std::string(40, 'a') + "..."));
  EXPECT_THAT(run.err, testing::Not(HasSubstr(std::string(41, 'a'))));
  const ProgramRun word = boule_run({"\x1b[31m\n" + std::string(100, 'b')});
  EXPECT_EQ(word.exit_code, 2);
  EXPECT_THAT(word.err, HasSubstr("'\\x1b[31m\\x0abbb"));
  EXPECT_THAT(word.err, testing::Not(HasSubstr(std::string(41, 'b'))));
  const ProgramRun flag = boule_run({"isa", "--json=\x1b"});
  EXPECT_EQ(flag.exit_code, 2);
  EXPECT_THAT(flag.err, testing::Not(HasSubstr("\x1b")));
}

TEST_F(Errors, UnwritableStandardOutputIsAnError) {
  for (const char* command : {"isa", "--help", "--version", "isa --json", "info scene.toml"}) {
    small_scene();
    const std::string line =
        "cd " + path("") + " && \"" BOULE_PROGRAM "\" " + command + " > /dev/full";
    const ProgramRun run = run_program("/bin/sh", {{"-c", line}, {}});
    EXPECT_EQ(run.exit_code, 1) << command;
    EXPECT_THAT(run.err, HasSubstr("cannot write 'standard output': No space left on device"));
  }
}

}  // namespace
}  // namespace boule::test
