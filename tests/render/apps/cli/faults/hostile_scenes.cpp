// Scenes that mean harm, or went through bad hands: what may be wrong with a text, in each format.
#include "tests/render/apps/cli/faults/hostile_files.h"

namespace boule::test {
namespace {

/// A TOML scene, without its first line.
std::function<std::string()> toml(const std::string& text) { return just("schema = 1\n" + text); }

/// An NFF scene, from line 7 on.
std::function<std::string()> nff(const std::string& text) { return just(nff_view + text); }

std::vector<HostileScene> joined(const std::vector<std::vector<HostileScene>>& lists) {
  std::vector<HostileScene> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// Cut off, empty, binary, of another encoding.
std::vector<HostileScene> broken_toml() {
  const char* const a = "a.toml";
  return {
      {"Empty", a, just(""), "1:1", "the scene is empty", "schema"},
      {"OnlyAMark", a, just("\xef\xbb\xbf"), "1:1", "the scene is empty", "schema"},
      {"Binary", a, binary, "1:1", "only strings and comments may hold such a character"},
      {"EndsInAHeader", a, toml("[camera"), "2:8", "not valid TOML"},
      {"EndsInAKey", a, toml("[camera]\ney"), "3:3", "not valid TOML"},
      {"EndsInAnArray", a, toml("[camera]\neye = [0, 1,"), "3:13", "not valid TOML", "camera.eye"},
      {"EndsInAString", a, toml("[camera]\ntype = \"pin"), "3:12", "not valid TOML", "camera.type"},
      {"EndsInANumber", a, toml("[camera]\nfov = 4e"), "3:9", "not valid TOML", "camera.fov"},
      {"Utf16", a, [] { return utf16("schema = 1\n"); }, "1:1", "is UTF-16 text"},
      {"Utf16HighFirst", a, [] { return utf16_high_first("schema = 1\n"); }, "1:1",
       "is UTF-16 text"},
      {"NotUtf8", a, toml("[camera]\ntype = \"\xc0\xaf\"\n"), "3:8", "invalid utf-8",
       "camera.type"},
      {"Nul", a, just(std::string("schema = 1\n#\0\n", 14)), "2:2", "holds a NUL"},
      {"AllNul", a, [] { return std::string(16 * mebibyte, '\0'); }, "1:1", "holds a NUL"},
  };
}

/// Long and deep.
std::vector<HostileScene> long_toml() {
  const char* const a = "a.toml";
  return {
      {"LongKey", a, [] { return std::string(16 * mebibyte, 'k') + " = 1\n"; }, "1:1", "unknown"},
      {"LongLine", a,
       [] { return "schema = 1\na = \"" + std::string(16 * mebibyte, 'x') + "\"\n"; }, "2:1",
       "unknown key", "a"},
      {"LongString", a, [] { return "schema = 1\na = \"" + std::string(16 * mebibyte, 'x'); },
       "2:16777222", "not valid TOML"},
      {"LongNumber", a, [] { return "schema = " + std::string(16 * mebibyte, '1') + "\n"; }, "1:10",
       "not valid TOML"},
      {"LongComment", a, [] { return "#" + std::string(16 * mebibyte, '-') + "\n"; }, "1:1",
       "the scene is empty", "schema"},
      {"LongArray", a, [] { return "schema = 1\na = [" + repeated("1,", 16 * mebibyte) + "]\n"; },
       "2:2053", "an array has at most 1024 values", "a"},
      {"LongArrayOfArrays", a,
       [] { return "schema = 1\na = [" + repeated("[],\n", 16 * mebibyte) + "]\n"; }, "1025:3",
       "an array has at most 1024 values"},
      {"Brackets", a, [] { return "schema = " + std::string(100'000, '[') + "\n"; }, "1:266",
       "exceeded maximum nested value depth", "schema"},
      {"Braces", a, [] { return "schema = " + repeated("{a=", 300'000) + "\n"; }, "1:778",
       "exceeded maximum nested value depth", "schema"},
      {"ClosedBrackets", a,
       [] { return "schema = " + std::string(100'000, '[') + std::string(100'000, ']') + "\n"; },
       "1:266", "exceeded maximum nested value depth", "schema"},
      {"DottedKey", a, [] { return "schema = 1\na" + repeated(".a", 200'000) + " = 1\n"; }, "2:64",
       "a key has at most 32 dotted parts"},
      {"DottedTable", a, [] { return "schema = 1\n[a" + repeated(".a", 200'000) + "]\n"; }, "2:65",
       "a key has at most 32 dotted parts"},
  };
}

/// Numbers.
std::vector<HostileScene> numbers_toml() {
  const char* const a = "a.toml";
  return {
      {"SchemaBeyond32", a, just("schema = 4294967297\n"), "1:10", "must be an integer", "schema"},
      {"SppBeyond32", a, toml("[image]\nspp = 4294967297\n"), "3:7", "must be an integer",
       "image.spp"},
      {"SizeBeyond32", a, toml("[image]\nsize = [4294967304, 8]\n"), "3:9", "must be an integer",
       "image.size"},
      {"SizeBeyond64", a, toml("[image]\nsize = [18446744073709551624, 8]\n"), "3:9",
       "not valid TOML", "image.size"},
      {"DepthBeyond32", a, toml("[render]\nmax_depth = 4294967297\n"), "3:13", "must be an integer",
       "render.max_depth"},
      {"FrameBeyond32", a, toml("[camera]\n[[camera.key]]\nframe = 4294967297\n"), "4:9",
       "must be an integer", "camera.key[0].frame"},
      {"Nan", a, toml("[[sphere]]\nradius = nan\n"), "3:10", "must be finite", "sphere[0].radius"},
      {"Inf", a, toml("[[sphere]]\ncenter = [0, -inf, 0]\n"), "3:10", "must be finite",
       "sphere[0].center"},
      {"BeyondDouble", a, toml("[[sphere]]\nradius = 1e999\n"), "3:10", "1e999",
       "sphere[0].radius"},
      {"BeyondFloat", a, toml("[[sphere]]\nradius = 1e39\n"), "3:10",
       "too large for a 32-bit float", "sphere[0].radius"},
      {"LightNan", a, toml("[[light]]\nintensity = [nan, 1, 1]\n"), "3:13", "must be finite",
       "light[0].intensity"},
      {"IorInf", a, toml("[material.g]\ntype = \"glass\"\nior = inf\n"), "4:7", "must be finite",
       "material.g.ior"},
  };
}

/// Types and components.
std::vector<HostileScene> types_toml() {
  const char* const a = "a.toml";
  return {
      {"TextForANumber", a, toml("[[sphere]]\nradius = \"1\"\n"), "3:10", "expected a number",
       "sphere[0].radius"},
      {"NumberForText", a, toml("[camera]\ntype = 1\n"), "3:8", "expected a string", "camera.type"},
      {"DateForANumber", a, toml("[[plane]]\npoint = [0, 1979-05-27, 0]\n"), "3:13",
       "expected a number, got a date or time", "plane[0].point"},
      {"TableForAList", a, toml("[sphere]\nradius = 1\n"), "2:1", "got a table", "sphere"},
      {"NumberForATable", a, toml("image = 5\n"), "2:9", "expected a table", "image"},
      {"ArrayOfArrays", a, toml("[[sphere]]\ncenter = [[0], 0, 0]\n"), "3:11", "expected a number",
       "sphere[0].center"},
      {"TwoComponents", a, toml("[[sphere]]\ncenter = [0, 0]\n"), "3:10", "got 2",
       "sphere[0].center"},
      {"FourComponents", a, toml("[background]\ncolor = [0, 0, 0, 1]\n"), "3:9", "got 4",
       "background.color"},
      {"NoComponents", a, toml("[[plane]]\nnormal = []\n"), "3:10", "got 0", "plane[0].normal"},
      {"MissingComponent", a, toml("[camera]\neye = [0, 0, 5]\n"), "2:1", "missing key 'look_at'",
       "camera.look_at"},
  };
}

/// Names.
std::vector<HostileScene> names_toml() {
  const char* const a = "a.toml";
  return {
      {"UnknownTable", a, toml("[camara]\n"), "2:2", "did you mean 'camera'?", "camara"},
      {"UnknownKey", a, toml("[[sphere]]\nraduis = 1\n"), "3:1", "did you mean 'radius'?",
       "sphere[0].raduis"},
      {"UnknownMaterial", a, toml("[material.red]\n[[sphere]]\nmaterial = \"rad\"\n"), "4:12",
       "did you mean 'red'?", "sphere[0].material"},
      {"UnknownGroup", a, toml("[[group.tree.sphere]]\n[[instance]]\ngroup = \"three\"\n"), "4:9",
       "did you mean 'tree'?", "instance[0].group"},
      {"KeyTwice", a, toml("[[sphere]]\nradius = 1\nradius = 1\n"), "4:10", "cannot redefine",
       "sphere[0].radius"},
      {"TableTwice", a, toml("[image]\n[render]\n[image]\n"), "4:1", "cannot redefine", "image"},
      {"MaterialTwice", a, toml("[material.a]\n[material.a]\n"), "3:1", "cannot redefine",
       "material.a"},
  };
}

/// Files that are missing, or name themselves.
std::vector<HostileScene> files_toml() {
  const char* const a = "a.toml";
  return {
      {"IsItsOwnSpheres", a, just(spheres_of(a)), "3:8", "'a.toml': ", "spheres[0].file"},
      {"IsItsOwnLens", a, just(lens_of(a)), "1", "expected four numbers", "camera.file"},
      {"IsItsOwnSky", a, just(sky_of(a)), "3:8", "'a.toml': cannot read it", "background.file"},
      {"NoSpheres", a, just(spheres_of("no.npy")), "3:8",
       "'no.npy': cannot read it: No such file or directory", "spheres[0].file"},
      {"NoLens", a, just(lens_of("no.lens")), "3:8",
       "'no.lens': cannot read it: No such file or directory", "camera.file"},
      {"NoSky", a, just(sky_of("no.exr")), "3:8",
       "'no.exr': cannot read it: No such file or directory", "background.file"},
      {"NoMap", a,
       toml("[camera]\neye = [0, 0, 5]\nlook_at = [0, 0, 0]\n[camera.distortion]\nfile = "
            "\"no.exr\"\n"),
       "6:8", "'no.exr': cannot read it: No such file or directory", "camera.distortion.file"},
      {"GroupInItself", a, toml("[[group.a.instance]]\ngroup = \"a\"\n"), "3:9", "makes a cycle",
       "group.a.instance[0].group"},
      {"GroupsInEachOther", a,
       toml("[[group.a.instance]]\ngroup = \"b\"\n[[group.b.instance]]\ngroup = \"a\"\n"), "5:9",
       "makes a cycle: 'a' -> 'b' -> 'a'", "group.b.instance[0].group"},
  };
}

/// Cut off, empty, binary, of another encoding.
std::vector<HostileScene> broken_nff() {
  const char* const a = "a.nff";
  return {
      {"Empty", a, just(""), "1:1", "the file has no v block", "v"},
      {"Binary", a, binary, "1:1", "unknown entity"},
      {"EndsInTheView", a, just("v\nfrom 0 0 5\nat 0 0"), "3:7", "the line ends here", "v.at"},
      {"EndsAfterTheView", a, just("v\nfrom 0 0 5\nat 0 0 0\n"), "1:1", "lacks its line 'up'",
       "v.up"},
      {"EndsInASphere", a, nff("s 0 0 0 1\ns 0 0"), "8:6", "the line ends here", "s.center"},
      {"EndsInANumber", a, nff("s 0 0 0 1e"), "7:9", "got '1e'", "s.radius"},
      {"EndsInAPolygon", a, nff("p 3\n0 0 0\n1 0 0\n"), "9:6", "the file ends after 2 of 3", "p"},
      {"Utf16", a, [] { return utf16(nff_view); }, "1:1", "is UTF-16 text"},
      {"Utf16HighFirst", a, [] { return utf16_high_first(nff_view); }, "1:1", "is UTF-16 text"},
      {"Nul", a, nff(std::string("s 0 0 0 1\n#\0\n", 13)), "8:2", "holds a NUL"},
  };
}

/// Long.
std::vector<HostileScene> long_nff() {
  const char* const a = "a.nff";
  return {
      {"LongWord", a, [] { return nff_view + std::string(16 * mebibyte, 'k') + "\n"; }, "7:1",
       "unknown entity"},
      {"LongLine", a, [] { return nff_view + repeated("s 0 0 0 1 ", 16 * mebibyte) + "\n"; },
       "7:11", "expected the end of the line", "s"},
      {"LongNumber", a,
       [] { return std::string(nff_view) + "s 0 0 0 " + std::string(16 * mebibyte, '1') + "\n"; },
       "7:9", "too large for a 32-bit float", "s.radius"},
      {"LongComment", a, [] { return "#" + std::string(16 * mebibyte, '-') + "\n"; }, "1:1",
       "the file has no v block", "v"},
      {"Brackets", a, nff(std::string(100'000, '(')), "7:1", "unknown entity"},
  };
}

/// Numbers.
std::vector<HostileScene> numbers_nff() {
  const char* const a = "a.nff";
  return {
      {"CountBeyond32", a, nff("p 4294967299\n0 0 0\n1 0 0\n0 1 0\n"), "7:3",
       "an integer of 32 bits", "p"},
      {"CountWithoutData", a, nff("p 2147483647\n0 0 0\n"), "8:6",
       "the file ends after 1 of 2147483647 vertices", "p"},
      {"PatchWithoutData", a, nff("pp 2000000000\n"), "7:14",
       "the file ends after 0 of 2000000000 vertices", "pp"},
      {"ResolutionBeyond32", a,
       just("v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 4294967304 8\n"), "6:12",
       "an integer of 32 bits", "v.resolution"},
      {"Nan", a, nff("s 0 nan 0 1\n"), "7:5", "must be finite", "s.center"},
      {"Inf", a, nff("s 0 0 0 inf\n"), "7:9", "must be finite", "s.radius"},
      {"BeyondDouble", a, nff("s 0 1e999 0 1\n"), "7:5", "too large for a 32-bit float",
       "s.center"},
      {"FromNan", a, just("v\nfrom 0 0 nan\n"), "2:10", "must be finite", "v.from"},
  };
}

/// Words and components.
std::vector<HostileScene> types_nff() {
  const char* const a = "a.nff";
  return {
      {"TextForANumber", a, nff("s zero 0 0 1\n"), "7:3", "expected a number, got 'zero'",
       "s.center"},
      {"FractionForACount", a, nff("p 3.5\n"), "7:3", "an integer of 32 bits", "p"},
      {"ThreeOfASphere", a, nff("s 0 0 0\n"), "7:8", "the line ends here", "s.radius"},
      {"FiveOfASphere", a, nff("s 0 0 0 1 2\n"), "7:11", "expected the end of the line", "s"},
      {"SevenOfAFill", a, nff("f 1 1 1 1 0 0 0\n"), "7:16", "the line ends here", "f.ior"},
      {"NineOfAFill", a, nff("f 1 1 1 1 0 0 0 1 1\n"), "7:19", "expected the end of the line", "f"},
      {"UnknownEntity", a, nff("sphere 0 0 0 1\n"), "7:1", "unknown entity 'sphere', expected 'v'",
       "sphere"},
      {"ViewTwice", a, nff("v\n"), "7:1", "a second v block", "v"},
      {"MemberTwice", a, just("v\nfrom 0 0 5\nfrom 0 0 5\n"), "3:1", "twice, first on line 2",
       "v.from"},
      {"BackgroundTwice", a, nff("b 0 0 0\nb 0 0 0\n"), "8:1", "a second background", "b"},
  };
}

}  // namespace

std::vector<HostileScene> hostile_toml() {
  return joined(
      {broken_toml(), long_toml(), numbers_toml(), types_toml(), names_toml(), files_toml()});
}

std::vector<HostileScene> hostile_nff() {
  return joined({broken_nff(), long_nff(), numbers_nff(), types_nff()});
}

}  // namespace boule::test
