// Files that mean harm, or went through bad hands: each is refused in little time and memory, with
// the place of what is wrong; nothing is written, nothing left. What a single wrong key or number
// is answered with is in tests/scene_file.
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "tests/cli/program.h"
#include "tests/cli/running_program.h"
#include "tests/render/npy_files.h"

namespace boule::test {
namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;

std::string repeated(const std::string& text, std::size_t bytes) {
  std::string all;
  all.reserve(bytes + text.size());
  while (all.size() < bytes) all += text;
  return all;
}

std::string utf16(const std::string& text) {
  std::string wide = "\xff\xfe";
  for (const char c : text) (wide += c) += '\0';
  return wide;
}

constexpr const char* view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 8 8\n";

/// A scene of a data file, "data.EXTENSION"; its name stands in line 3, column 8.
std::string spheres_of(const std::string& file) {
  return "schema = 1\n[[spheres]]\nfile = \"" + file + "\"\n";
}
std::string lens_of(const std::string& file) {
  return "schema = 1\n[camera]\nfile = \"" + file +
         "\"\ntype = \"lens\"\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n";
}
std::string sky_of(const std::string& file) {
  return "schema = 1\n[background]\nfile = \"" + file + "\"\ntype = \"environment\"\n";
}

struct Hostile {
  const char* name;
  std::string scene;                     ///< its file's name
  std::function<std::string()> text;     ///< of the scene
  std::string words;                     ///< of the error
  std::string data{};                    ///< the data file's name, if any
  std::function<std::string()> bytes{};  ///< of the data file
};
std::ostream& operator<<(std::ostream& out, const Hostile& hostile) { return out << hostile.name; }

/// The text as it stands.
std::function<std::string()> just(const std::string& text) {
  return [text] { return text; };
}

const Hostile scenes[] = {
    {"TomlUtf16", "a.toml", [] { return utf16("schema = 1\n"); }, ":1:1: error: is UTF-16 text"},
    {"NffUtf16", "a.nff", [] { return utf16(view); }, ":1:1: error: is UTF-16 text"},
    {"TomlNul", "a.toml", just(std::string("schema = 1\n#\0\n", 14)), ":2:2: error: holds a NUL"},
    {"TomlBinary", "a.toml",
     [] { return repeated(std::string("\x7f\x45\xfe\x01\xff", 5), mebibyte); }, ":1:1: error: "},
    {"NffBinary", "a.nff",
     [] { return repeated(std::string("\x7f\x45\xfe\x01\xff", 5), mebibyte); }, ":1:1: error: "},
    {"TomlAllNul", "a.toml", [] { return std::string(16 * mebibyte, '\0'); }, ":1:1: error: holds"},
    {"TomlLongKey", "a.toml", [] { return std::string(16 * mebibyte, 'k') + " = 1\n"; }, ":1:1: "},
    {"TomlLongLine", "a.toml",
     [] { return "schema = 1\na = \"" + std::string(16 * mebibyte, 'x') + "\"\n"; }, ":2:1: "},
    {"TomlLongString", "a.toml",
     [] { return "schema = 1\na = \"" + std::string(16 * mebibyte, 'x'); }, "a.toml:2:"},
    {"TomlLongNumber", "a.toml",
     [] { return "schema = " + std::string(16 * mebibyte, '1') + "\n"; }, "a.toml:1:"},
    {"TomlLongComment", "a.toml", [] { return "#" + std::string(16 * mebibyte, '-') + "\n"; },
     "missing key 'schema'"},
    {"NffLongWord", "a.nff", [] { return view + std::string(16 * mebibyte, 'k') + "\n"; },
     ":7:1: "},
    {"NffLongLine", "a.nff", [] { return view + repeated("s 0 0 0 1 ", 16 * mebibyte) + "\n"; },
     ":7:11: "},
    {"NffLongNumber", "a.nff",
     [] { return std::string(view) + "s 0 0 0 " + std::string(16 * mebibyte, '1') + "\n"; },
     ":7:9: "},
    {"TomlBrackets", "a.toml", [] { return "schema = " + std::string(100'000, '[') + "\n"; },
     "a.toml:1:"},
    {"TomlBraces", "a.toml", [] { return "schema = " + repeated("{a=", 300'000) + "\n"; },
     "a.toml:1:"},
    {"TomlClosedBrackets", "a.toml",
     [] { return "schema = " + std::string(100'000, '[') + std::string(100'000, ']') + "\n"; },
     "a.toml:1:"},
    {"TomlDottedKey", "a.toml", [] { return "schema = 1\na" + repeated(".a", 200'000) + " = 1\n"; },
     ":2:64: error: a key has at most 32 dotted parts"},
    {"TomlDottedTable", "a.toml", [] { return "schema = 1\n[a" + repeated(".a", 200'000) + "]\n"; },
     ":2:65: error: a key has at most 32 dotted parts"},
    {"TomlCountBeyond32", "a.toml", just("schema = 4294967297\n"),
     ":1:10: error: must be an integer"},
    {"NffCountBeyond32", "a.nff", just(std::string(view) + "p 4294967299\n0 0 0\n1 0 0\n0 1 0\n"),
     ":7:3: error: "},
    {"NffCountWithoutData", "a.nff", just(std::string(view) + "p 2147483647\n0 0 0\n"),
     "the file ends after 1 of 2147483647 vertices"},
    {"TomlIsItsOwnData", "a.toml", just(spheres_of("a.toml")), ":3:8: error: 'a.toml': "},
    {"TomlIsItsOwnLens", "a.toml", just(lens_of("a.toml")), ":3:8: error: 'a.toml': line 1: "},
    {"TomlIsItsOwnSky", "a.toml", just(sky_of("a.toml")), ":3:8: error: 'a.toml': cannot read it"},
};

const Hostile data_files[] = {
    {"NpyHugeCount", "a.toml", just(spheres_of("d.npy")), ":3:8: error: 'd.npy': ", "d.npy",
     [] { return npy_file(npy_dict("'<f4'", "(4000000000, 4)"), "0123456789abcdef"); }},
    {"NpyCountThatWraps", "a.toml", just(spheres_of("d.npy")), ":3:8: error: 'd.npy': ", "d.npy",
     [] { return npy_file(npy_dict("'<f4'", "(4294967297, 4)"), "0123456789abcdef"); }},
    {"NpyLongHeader", "a.toml", just(spheres_of("d.npy")), ":3:8: error: 'd.npy': ", "d.npy",
     [] { return npy_file(std::string(16 * mebibyte, '('), "", 2); }},
    {"NpyBrackets", "a.toml", just(spheres_of("d.npy")), ":3:8: error: 'd.npy': ", "d.npy",
     [] { return npy_file("{'descr': " + std::string(60'000, '['), ""); }},
    {"NpyUtf16", "a.toml", just(spheres_of("d.npy")), ":3:8: error: 'd.npy': ", "d.npy",
     [] { return utf16("NUMPY"); }},
    {"LensUtf16", "a.toml", just(lens_of("d.lens")), ":3:8: error: 'd.lens': ", "d.lens",
     [] { return utf16("1 1 1 1\n"); }},
    {"LensNul", "a.toml", just(lens_of("d.lens")), ":3:8: error: 'd.lens': ", "d.lens",
     just(std::string("1 1\0 1 1\n", 9))},
    {"LensLongLine", "a.toml", just(lens_of("d.lens")), ":3:8: error: 'd.lens': line 1: ", "d.lens",
     [] { return repeated("1 ", 16 * mebibyte); }},
    {"LensManyElements", "a.toml", just(lens_of("d.lens")), ":3:8: error: must gather light",
     "d.lens", [] { return repeated("1 1 1 1\n", 4 * mebibyte); }},
    {"LensEmpty", "a.toml", just(lens_of("d.lens")), ":3:8: error: ", "d.lens", just("")},
    {"PictureEmpty", "a.toml", just(sky_of("d.exr")), ":3:8: error: 'd.exr': ", "d.exr", just("")},
    {"PictureNul", "a.toml", just(sky_of("d.png")), ":3:8: error: 'd.png': ", "d.png",
     [] { return std::string(mebibyte, '\0'); }},
    {"PictureWithoutPixels", "a.toml", just(sky_of("d.ppm")), ":3:8: error: 'd.ppm': ", "d.ppm",
     just("P6 65535 65535 255\n")},
    {"PictureBeyond32", "a.toml", just(sky_of("d.ppm")), ":3:8: error: 'd.ppm': ", "d.ppm",
     just("P6 4294967297 1 255\n123")},
    {"PictureUtf16", "a.toml", just(sky_of("d.hdr")), ":3:8: error: 'd.hdr': ", "d.hdr",
     [] { return utf16("#?RADIANCE\n"); }},
    {"ExrHugeAttribute", "a.toml", just(sky_of("d.exr")), ":3:8: error: 'd.exr': ", "d.exr",
     just(std::string("\x76\x2f\x31\x01\x02\0\0\0text\0string\0\xff\xff\xff\x3fx", 25))},
};

class HostileFiles : public ProgramTest, public testing::WithParamInterface<Hostile> {
 protected:
  /// What the program takes: seconds, and bytes at most.
  struct Cost {
    double seconds;
    std::size_t bytes;
  };

  /// Renders the scene in a child of its own, so that its memory can be told from others'.
  Cost expect_refused(const std::string& scene, const std::string& words) const {
    const auto before = files();
    const Watch watch;
    const pid_t child = ::fork();
    if (child == 0) {
      const ProgramRun run = boule_run({"render", scene, "-o", path("out.png"), "-q"});
      const bool starts = run.err.starts_with(scene + ":");
      const bool has_words = run.err.find(words) != std::string::npos;
      const auto lines = std::count(run.err.begin(), run.err.end(), '\n');
      const bool good = run.exit_code == 3 && starts && has_words && lines >= 1 && lines <= 3;
      if (!good)
        std::fprintf(stderr, "exit %d: %s\n", run.exit_code, run.err.substr(0, 400).c_str());
      ::_exit(good ? 0 : 1);
    }
    int status = 0;
    rusage used{};
    ::wait4(child, &status, 0, &used);
    EXPECT_EQ(status, 0) << words;
    EXPECT_EQ(files(), before);
    return {watch.seconds(), static_cast<std::size_t>(used.ru_maxrss) * 1024};
  }
};

TEST_P(HostileFiles, AreRefusedInLittleTimeAndMemory) {
  const Hostile& hostile = GetParam();
  if (!hostile.data.empty()) write(hostile.data, hostile.bytes());
  const Cost cost = expect_refused(write(hostile.scene, hostile.text()), hostile.words);
  EXPECT_LT(cost.seconds, 5);
  EXPECT_LT(cost.bytes, 256 * mebibyte);
}

const auto name_of = [](const auto& hostile) { return std::string(hostile.param.name); };
INSTANTIATE_TEST_SUITE_P(Scenes, HostileFiles, testing::ValuesIn(scenes), name_of);
INSTANTIATE_TEST_SUITE_P(Data, HostileFiles, testing::ValuesIn(data_files), name_of);

/// What is no regular file: as the scene, and as each kind of data file.
TEST_F(HostileFiles, WhatIsNoFileIsRefusedWhereverItIsNamed) {
  ASSERT_EQ(::mkfifo(path("fifo").c_str(), 0600), 0);
  std::filesystem::create_directory(path("folder"));
  std::filesystem::create_symlink("itself", path("itself"));
  const std::pair<std::string, std::string> kinds[] = {{path("fifo"), "a FIFO"},
                                                       {path("folder"), "a directory"},
                                                       {"/dev/zero", "a device"},
                                                       {path("itself"), "Too many levels"},
                                                       {"/proc/self/mem/x", "Not a directory"}};
  int number = 0;
  for (const auto& [target, words] : kinds) {
    for (const std::string extension : {"toml", "nff", "npy", "lens", "exr", "png"}) {
      const std::string link = "link" + std::to_string(++number) + "." + extension;
      std::filesystem::create_symlink(target, path(link));
      std::string scene = path(link);
      if (extension == "npy") scene = write("npy.toml", spheres_of(link));
      if (extension == "lens") scene = write("lens.toml", lens_of(link));
      if (extension == "exr" || extension == "png") scene = write("sky.toml", sky_of(link));
      const Cost cost = expect_refused(scene, words);
      EXPECT_LT(cost.seconds, 5) << link;
      EXPECT_LT(cost.bytes, 256 * mebibyte) << link;
    }
  }
}

/// Permissions do not bind root.
TEST_F(HostileFiles, WhatMayNotBeReadIsRefused) {
  const std::string scene = write("secret.toml", "schema = 1\n");
  ASSERT_EQ(::chmod(scene.c_str(), 0), 0);
  if (::geteuid() == 0) GTEST_SKIP() << "root reads everything";
  expect_refused(scene, "Permission denied");
}

TEST_F(HostileFiles, AByteOrderMarkAndLinesOfWindowsAreWelcome) {
  const std::string mark = "\xef\xbb\xbf";
  write("d.lens", mark + "# flat glass\r\n30 4 1.5 20\r\n-30 0 1 20\r\n");
  const std::string toml = write("a.toml", mark + "schema = 1\r\n[[sphere]]\r\nradius = 2\r\n");
  const std::string lens = write("b.toml", mark + lens_of("d.lens"));
  std::string text = mark + view + "s 0 0 0 1\n";
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2)
    text.replace(i, 1, "\r\n");
  for (const std::string& scene : {toml, lens, write("c.nff", text)}) {
    const ProgramRun run = boule_run({"info", scene});
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
}

}  // namespace
}  // namespace boule::test
