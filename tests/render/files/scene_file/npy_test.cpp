#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "render/files/file/npy_header.h"
#include "tests/render/files/scene_file/scene_dump.h"
#include "tests/render/files/scene_file/scene_folder.h"

// Bulk spheres: what .npy files hold, good and hostile.

namespace boule {
namespace {

using test::dump;
using test::SceneFolder;

/// A header as numpy.save writes it: padded to 64 bytes, one newline at the end.
std::string npy_header(const std::string& dict, char version = 1) {
  const std::size_t before = version == 1 ? 10 : 12;
  std::string text = dict;
  while ((before + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  std::string header("\x93NUMPY", 6);
  header += version;
  header += '\0';
  for (std::size_t i = 0; i < before - 8; ++i) {
    header += static_cast<char>(text.size() >> (8 * i) & 255);
  }
  return header + text;
}

std::string dict(const std::string& descr, const std::string& shape,
                 const std::string& order = "False") {
  return "{'descr': '" + descr + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }";
}

/// Little-endian bytes of numbers, as the machines of the tests have them.
template <class T>
std::string bytes(const std::vector<T>& numbers) {
  std::string text(numbers.size() * sizeof(T), '\0');
  if (!numbers.empty()) std::memcpy(text.data(), numbers.data(), text.size());
  return text;
}

/// Loads a scene whose only table is [[spheres]] of "cloud.npy" with these bytes.
Result<LoadedScene> load_cloud(const std::string& cloud, const std::string& keys = "") {
  const SceneFolder files;
  EXPECT_FALSE(files.write("cloud.npy", cloud).empty());
  return files.load("scene.toml", "schema = 1\n[[spheres]]\nfile = \"cloud.npy\"\n" + keys);
}

std::string dump_cloud(const std::string& cloud, const std::string& keys = "") {
  const auto loaded = load_cloud(cloud, keys);
  return loaded ? dump(loaded.value().scene) : format_diagnostic(loaded.error());
}

Scene two_spheres() {
  Scene scene;
  scene.materials = {{"default", Matte{}}};
  scene.spheres = {{{1, 2, 3}, 0.1f, 0}, {{-4, 5, 1e-40f}, 8, 0}};
  return scene;
}

TEST(Npy, Float32AndFloat64) {
  EXPECT_EQ(dump_cloud(npy_header(dict("<f4", "(2, 4)")) +
                       bytes<float>({1, 2, 3, 0.1f, -4, 5, 1e-40f, 8})),
            dump(two_spheres()));
  EXPECT_EQ(dump_cloud(npy_header(dict("<f8", "(2, 4)")) +
                       bytes<double>({1, 2, 3, 0.1, -4, 5, 1e-40, 8})),
            dump(two_spheres()));
}

TEST(Npy, ThreeColumnsAndARadius) {
  Scene expected = two_spheres();
  for (Sphere& sphere : expected.spheres) sphere.radius = 0.5f;
  EXPECT_EQ(dump_cloud(npy_header(dict("<f4", "(2, 3)")) + bytes<float>({1, 2, 3, -4, 5, 1e-40f}),
                       "radius = 0.5\n"),
            dump(expected));
}

TEST(Npy, HeaderVersions) {
  const std::string rows = bytes<float>({1, 2, 3, 0.1f, -4, 5, 1e-40f, 8});
  for (const char version : {char{1}, char{2}, char{3}}) {
    EXPECT_EQ(dump_cloud(npy_header(dict("<f4", "(2, 4)"), version) + rows), dump(two_spheres()));
  }
}

TEST(Npy, NoRowsAreNoSpheres) {
  const auto loaded = load_cloud(npy_header(dict("<f4", "(0, 4)")));
  ASSERT_TRUE(loaded.ok());
  EXPECT_TRUE(loaded.value().scene.spheres.empty());
}

TEST(Npy, ManyRowsKeepTheirOrder) {
  std::vector<float> rows;
  for (int i = 0; i < 10000; ++i) {
    rows.insert(rows.end(), {static_cast<float>(i), 0, 0, static_cast<float>(i + 1)});
  }
  const auto loaded = load_cloud(npy_header(dict("<f4", "(10000, 4)")) + bytes(rows));
  ASSERT_TRUE(loaded.ok());
  const std::vector<Sphere>& spheres = loaded.value().scene.spheres;
  ASSERT_EQ(spheres.size(), 10000u);
  for (int i = 0; i < 10000; ++i) {
    EXPECT_EQ(spheres[static_cast<std::size_t>(i)].center.x, static_cast<float>(i));
    EXPECT_EQ(spheres[static_cast<std::size_t>(i)].radius, static_cast<float>(i + 1));
  }
}

TEST(Npy, IdsFollowTheFileWhicheverTheTable) {
  const SceneFolder files;
  EXPECT_FALSE(files.write("a.npy", npy_header(dict("<f4", "(1, 4)")) + bytes<float>({0, 0, 0, 20}))
                   .empty());
  const auto loaded = files.load("scene.toml",
                                 "schema = 1\n"
                                 "[[sphere]]\nradius = 10\n[[spheres]]\nfile = \"a.npy\"\n"
                                 "[[sphere]]\nradius = 30\n[[spheres]]\nfile = \"a.npy\"\n"
                                 "material = \"m\"\n[material.m]\n");
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  Scene expected;
  expected.materials = {{"m", Matte{}}, {"default", Matte{}}};
  expected.spheres = {
      {{0, 0, 0}, 10, 1}, {{0, 0, 0}, 20, 1}, {{0, 0, 0}, 30, 1}, {{0, 0, 0}, 20, 0}};
  EXPECT_EQ(dump(loaded.value().scene), dump(expected));
}

struct BadCloud {
  const char* name;
  std::string cloud;
  const char* words;
  const char* keys = "";
};

std::ostream& operator<<(std::ostream& out, const BadCloud& bad) { return out << bad.name; }

class BadNpy : public testing::TestWithParam<BadCloud> {};

TEST_P(BadNpy, IsRefusedAtTheKeyFile) {
  const auto loaded = load_cloud(GetParam().cloud, GetParam().keys);
  ASSERT_FALSE(loaded.ok());
  const Diagnostic& error = loaded.error();
  EXPECT_EQ(error.line, 3);
  EXPECT_EQ(error.column, 8);
  EXPECT_EQ(error.key, "spheres[0].file");
  EXPECT_THAT(error.message, testing::StartsWith("'cloud.npy': "));
  EXPECT_THAT(error.message, testing::HasSubstr(GetParam().words));
}

constexpr double inf = std::numeric_limits<double>::infinity();

std::string one_row(const std::vector<double>& row) {
  return npy_header(dict("<f8", "(1, 4)")) + bytes(row);
}

std::string row_17(float radius) {
  std::vector<float> rows(4 * 18, 1.0f);
  rows.back() = radius;
  return npy_header(dict("<f4", "(18, 4)")) + bytes(rows);
}

const std::string row = bytes<float>({0, 0, 0, 1});

const BadCloud bad_clouds[] = {
    {"Empty", "", "does not begin with"},
    {"NoMagic", "not an npy file at all", "does not begin with"},
    {"Version", npy_header(dict("<f4", "(1, 4)"), 4) + row, "version is 4.0"},
    {"EndsInStart", std::string("\x93NUMPY\x01\x00", 8), "ends within its header"},
    {"EndsInHeader", npy_header(dict("<f4", "(1, 4)")).substr(0, 60), "ends within its header"},
    {"HugeHeader", std::string("\x93NUMPY\x02\x00\xff\xff\xff\xff", 12), "ends within its header"},
    {"LongHeader", npy_header(dict("<f4", "(1, 4)") + std::string(70000, ' '), 2) + row,
     "longer than 65536"},
    {"NoDict", npy_header("[]") + row, "no dict"},
    {"NoKeys", npy_header("{}") + row, "lacks"},
    {"OtherKey", npy_header("{'a': 1}") + row, "unknown header key 'a'"},
    {"KeyTwice", npy_header("{'descr': '<f4', 'descr': '<f4'}") + row, "given twice"},
    {"NoColon", npy_header("{'descr' '<f4'}") + row, "a key was expected"},
    {"OpenString", npy_header("{'descr") + row, "a key was expected"},
    {"NoComma", npy_header("{'descr': '<f4' 'shape': ()}") + row, "',' or '}'"},
    {"TextBehind", npy_header(dict("<f4", "(1, 4)") + "x") + row, "follows the header"},
    {"Structured",
     npy_header("{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (1,)}") + row,
     "has named fields, expected rows of numbers: [[particles]] reads it"},
    {"BigEndian", npy_header(dict(">f4", "(1, 4)")) + row, "holds '>f4', expected '<f4'"},
    {"Half", npy_header(dict("<f2", "(2, 4)")) + row, "holds '<f2'"},
    {"Integers", npy_header(dict("<i4", "(1, 4)")) + row, "holds '<i4'"},
    {"Fortran", npy_header(dict("<f4", "(1, 4)", "True")) + row, "Fortran order"},
    {"OrderText", npy_header(dict("<f4", "(1, 4)", "Maybe")) + row, "unexpected value"},
    {"OneDimension", npy_header(dict("<f4", "(4,)")) + row, "shape (4)"},
    {"NoDimension", npy_header(dict("<f4", "()")) + row, "shape ()"},
    {"ThreeDimensions", npy_header(dict("<f4", "(1, 1, 4)")) + row, "shape (1, 1, 4)"},
    {"NineDimensions", npy_header(dict("<f4", "(1, 1, 1, 1, 1, 1, 1, 1, 4)")) + row, "unexpected"},
    {"FiveColumns", npy_header(dict("<f4", "(1, 5)")) + row, "shape (1, 5)"},
    {"NegativeRows", npy_header(dict("<f4", "(-1, 4)")) + row, "unexpected value"},
    {"RowsBeyond64Bits", npy_header(dict("<f4", "(18446744073709551616, 4)")) + row, "unexpected"},
    {"RowsThatOverflow", npy_header(dict("<f4", "(1152921504606846977, 4)")) + row,
     "declares 1152921504606846977 rows of 16 bytes, but holds 16 bytes"},
    {"TooShort", npy_header(dict("<f4", "(2, 4)")) + row, "declares 2 rows"},
    {"TooLong", npy_header(dict("<f4", "(1, 4)")) + row + row, "declares 1 rows"},
    {"ByteMissing", npy_header(dict("<f4", "(1, 4)")) + row.substr(1), "holds 15 bytes"},
    {"NoRadius", npy_header(dict("<f4", "(1, 3)")) + row.substr(4), "'radius' is missing"},
    {"TwoRadii", npy_header(dict("<f4", "(1, 4)")) + row, "contradicts", "radius = 1\n"},
    {"Row17Zero", row_17(0), "row 17: radius must be finite and above 0, is 0"},
    {"Row17Negative", row_17(-1), "row 17: radius must be finite and above 0, is -1"},
    {"CenterNan", one_row({0, std::nan(""), 0, 1}), "row 0: center must be finite"},
    {"RadiusInf", one_row({0, 0, 0, inf}), "row 0: radius must be finite"},
    {"CenterTooLarge", one_row({0, 0, -1e39, 1}), "row 0: center z is too large"},
    {"RadiusTooLarge", one_row({0, 0, 0, 1e300}), "row 0: radius is too large"},
    {"RadiusUnderflow", one_row({0, 0, 0, 1e-300}), "row 0: radius must be finite and above 0"},
};

INSTANTIATE_TEST_SUITE_P(Clouds, BadNpy, testing::ValuesIn(bad_clouds),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(NpyHeader, EveryPrefixOfADictIsRefused) {
  const std::string whole = "{\"shape\": (2, 4), 'descr': '<f4', 'fortran_order': False}";
  const auto header = parse_npy_dict(whole);
  ASSERT_TRUE(header.ok());
  EXPECT_EQ(header.value().descr, "<f4");
  EXPECT_EQ(header.value().shape, (std::vector<std::uint64_t>{2, 4}));
  for (std::size_t n = 0; n < whole.size(); ++n) {
    EXPECT_FALSE(parse_npy_dict(whole.substr(0, n)).ok()) << n;
  }
}

}  // namespace
}  // namespace boule
