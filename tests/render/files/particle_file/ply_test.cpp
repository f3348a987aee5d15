#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/render/files/particle_file/broken_file.h"
#include "tests/render/files/particle_file/read_text.h"
#include "tests/render/npy_files.h"

namespace boule::ply {
namespace {

using test::append_bytes;
using test::BrokenFile;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> numbers(const ParticleFrame& frame, const std::string& name) {
  const NumberColumn* const column = find_number_column(frame, name);
  return column == nullptr ? std::vector<double>() : column->values;
}

/// The bytes of a number in either order.
template <class T>
void append(std::string& to, T value, bool is_big_endian) {
  std::string bytes;
  append_bytes(bytes, value);
  if (is_big_endian) std::reverse(bytes.begin(), bytes.end());
  to += bytes;
}

std::string header(const std::string& encoding, const std::string& elements) {
  return "ply\nformat " + encoding + " 1.0\ncomment made by hand\nobj_info none\n" + elements +
         "end_header\n";
}

const std::string vertex_of_all_types =
    "element vertex 2\nproperty double x\nproperty float y\nproperty float64 z\n"
    "property char a\nproperty uchar red\nproperty short b\nproperty ushort green\n"
    "property int c\nproperty uint d\nproperty int64 e\nproperty float32 scalar_radius\n";

std::string binary_of_all_types(bool is_big_endian) {
  std::string bytes =
      header(is_big_endian ? "binary_big_endian" : "binary_little_endian",
             "element camera 2\nproperty float f\nproperty list uchar int l\n" +
                 vertex_of_all_types + "element face 1\nproperty list uchar int vertex_indices\n");
  const auto put = [&](auto value) { append(bytes, value, is_big_endian); };
  for (const std::uint8_t count : {3, 0}) {
    put(1.0F);
    put(count);
    for (int i = 0; i < count; ++i) put(std::int32_t{i});
  }
  for (const int i : {0, 1}) {
    put(1e300 + i);
    put(0.1F);
    put(-2.5);
    put(static_cast<std::int8_t>(-1 - i));
    put(static_cast<std::uint8_t>(255 * i));
    put(std::int16_t{-300});
    put(std::uint16_t{13107});  // a fifth of 65535
    put(std::int32_t{-70000});
    put(std::uint32_t{4000000000U});
    put(std::int64_t{-5000000000});
    put(0.5F);
  }
  put(std::uint8_t{3});
  for (int i = 0; i < 3; ++i) put(std::int32_t{0});
  return bytes;
}

TEST(Ply, BinaryFilesHoldAllTypesEitherEndian) {
  for (const bool is_big_endian : {false, true}) {
    const auto read = read_particles("a.ply", binary_of_all_types(is_big_endian));
    ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
    const ParticleFrame& frame = read.value();
    ASSERT_EQ(frame.size(), 2U);
    EXPECT_EQ(frame.positions[0], (Vec3d{1e300, double{0.1F}, -2.5}));
    EXPECT_THAT(numbers(frame, "a"), ElementsAre(-1, -2));
    EXPECT_THAT(numbers(frame, "red"), ElementsAre(0, 1));
    EXPECT_THAT(numbers(frame, "b"), ElementsAre(-300, -300));
    EXPECT_THAT(numbers(frame, "green"), ElementsAre(0.2, 0.2));
    EXPECT_THAT(numbers(frame, "c"), ElementsAre(-70000, -70000));
    EXPECT_THAT(numbers(frame, "d"), ElementsAre(4e9, 4e9));
    EXPECT_THAT(numbers(frame, "e"), ElementsAre(-5e9, -5e9));
    EXPECT_THAT(numbers(frame, "radius"), ElementsAre(0.5, 0.5));
    ASSERT_EQ(frame.notes.size(), 2U);
    EXPECT_THAT(frame.notes[1], HasSubstr("left out 1 of the element 'face'"));
  }
}

TEST(Ply, TextFilesAreReadAlike) {
  const std::string text =
      header("ascii", "element camera 1\nproperty float f\n" + vertex_of_all_types +
                          "element face 1\nproperty list uchar int vertex_indices\n") +
      "1.5\n1e300 0.1 -2.5 -1 0 -300 13107 -70000 4e9 -5e9 .5\n"
      "1e300 0.2 -2.5 -2 255 -300 65535 -7 4e9 -5e9 .25\n3 0 0 0\n";
  std::string with_returns;
  for (const char c : text) with_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& bytes : {text, with_returns}) {
    const auto read = read_particles("a.ply", bytes);
    ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
    const ParticleFrame& frame = read.value();
    EXPECT_EQ(frame.positions[1], (Vec3d{1e300, 0.2, -2.5}));
    EXPECT_THAT(numbers(frame, "red"), ElementsAre(0, 1));
    EXPECT_THAT(numbers(frame, "green"), ElementsAre(0.2, 1));
    EXPECT_THAT(numbers(frame, "radius"), ElementsAre(0.5, 0.25));
  }
}

TEST(Ply, BinaryDataBeginsAfterTheHeaderLine) {
  std::string bytes =
      "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\n"
      "property float x\r\nproperty float y\r\nproperty float z\r\nend_header\r\n";
  for (const float x : {1.0F, 2.0F, 3.0F}) append_bytes(bytes, x);
  const auto read = read_particles("unnamed", bytes);  // known by its content
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  EXPECT_THAT(read.value().positions, ElementsAre(Vec3d{1, 2, 3}));
}

const std::string floats = "property float x\nproperty float y\nproperty float z\n";

TEST(Ply, FloatColoursStayOtherScalarsLosePrefixes) {
  const std::string text =
      header("ascii", "element vertex 1\n" + floats +
                          "property float red\nproperty float scalar_a\nproperty float scalar_b\n"
                          "property float b\nproperty int type\n") +
      "1 2 3 0.25 4 5 6 7\n";
  const auto read = read_particles("a.ply", text);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const ParticleFrame& frame = read.value();
  EXPECT_THAT(numbers(frame, "red"), ElementsAre(0.25));
  EXPECT_THAT(numbers(frame, "a"), ElementsAre(4));
  EXPECT_THAT(numbers(frame, "scalar_b"), ElementsAre(5));
  EXPECT_THAT(numbers(frame, "b"), ElementsAre(6));
  ASSERT_TRUE(frame.species);
  EXPECT_THAT(frame.species->texts, ElementsAre("7"));
}

TEST(Ply, KeepsWantedColumnsOnly) {
  const ParticleFileOptions options{.wanted = std::vector<std::string>{"d"}};
  const auto read = read_particles("a.ply", binary_of_all_types(false), options);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  ASSERT_EQ(read.value().numbers.size(), 1U);
  EXPECT_EQ(read.value().numbers[0].name, "d");
}

TEST(Ply, ManyPointsAreReadInPieces) {
  constexpr std::int32_t n = 200000;
  std::string bytes = header("binary_little_endian", "element vertex 200000\nproperty uchar pad\n" +
                                                         floats + "property int id\n");
  for (std::int32_t i = 0; i < n; ++i) {
    append_bytes(bytes, std::uint8_t{0});
    for (const int k : {0, 1, 2}) append_bytes(bytes, static_cast<float>(i) + 0.25F * k);
    append_bytes(bytes, i);
  }
  const auto read = read_particles("a.ply", bytes);
  ASSERT_TRUE(read.ok()) << format_diagnostic(read.error());
  const std::vector<double> ids = numbers(read.value(), "id");
  ASSERT_EQ(ids.size(), std::size_t{n});
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto x = static_cast<double>(i);
    ASSERT_EQ(ids[i], x);
    ASSERT_EQ(read.value().positions[i], (Vec3d{x, x + 0.25, x + 0.5}));
  }
}

std::string binary_points(const std::string& count, const std::string& data) {
  return header("binary_little_endian", "element vertex " + count + "\n" + floats) + data;
}

std::string ascii(const std::string& elements, const std::string& data) {
  return header("ascii", elements) + data;
}

std::string with_nan() {
  std::string data(24, '\0');
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < 4; ++i) data[16 + i] = reinterpret_cast<const char*>(&nan)[i];
  return binary_points("2", data);
}

std::vector<BrokenFile> broken_headers() {
  const std::string points = "element vertex 2\n" + floats, data = "1 2 3\n4 5 6\n";
  return {
      {"Empty", "", "1:1: expected the line 'ply', found '' ()"},
      {"NoMagic", "plx\n", "1:1: expected the line 'ply', found 'plx' (plx)"},
      {"NoFormat", "ply\nelement vertex 0\nend_header\n", "3:1: the header has no line 'format'"},
      {"TwoFormats", "ply\nformat ascii 1.0\nformat ascii 1.0\n", "3:1: a second line 'format'"},
      {"UnknownEncoding", "ply\nformat binary 1.0\n", "2:8: expected ascii, binary_little_endian"},
      {"UnknownVersion", "ply\nformat ascii 2.0\n", "2:14: expected version 1.0, found '2.0'"},
      {"ShortFormat", "ply\nformat ascii\n", "2:1: expected 'format ENCODING 1.0' (format)"},
      {"HeaderCutOff", "ply\nformat ascii 1.0\nelement vertex 2\n",
       "4:1: the file ends within the header (end_header)"},
      {"UnknownStatement", "ply\nformat ascii 1.0\nelements vertex 2\n",
       "3:1: expected format, element, property, comment, obj_info or end_header, found "
       "'elements'"},
      {"NoCount", ascii("element vertex\n" + floats, data), "5:1: expected 'element NAME COUNT'"},
      {"NegativeCount", ascii("element vertex -2\n" + floats, data),
       "5:16: expected a count, found '-2' (element)"},
      {"CountBeyond64Bits", ascii("element vertex 99999999999999999999\n" + floats, data),
       "5:16: expected a count"},
      {"TwoVertices", ascii(points + points, data), "9:1: a second element 'vertex' (element)"},
      {"PropertyFirst", ascii("property float x\n", ""), "5:1: a property before any element"},
      {"UnknownType", ascii("element vertex 1\nproperty half x\n", ""),
       "6:10: expected a type such as uchar, int or float, found 'half' (property)"},
      {"NamelessProperty", ascii("element vertex 1\nproperty float\n", ""),
       "6:1: expected 'property TYPE NAME'"},
      {"ListOfFloatCount", ascii("element vertex 1\nproperty list float int l\n", ""),
       "6:15: expected a type of whole numbers, found 'float' (property)"},
      {"NoVertex", ascii("element point 2\n" + floats, data), "it has no element 'vertex'"},
      {"ListInVertex", ascii(points + "property list uchar int near\n", data),
       "5:1: its property 'near' is a list, expected one number a point (vertex)"},
      {"NoZ", ascii("element vertex 1\nproperty float x\nproperty float y\n", "1 2\n"),
       "5:0: there is no column of positions for z (z)"},
      {"TwoX", ascii(points + "property float x\n", data), "two columns have the name 'x' (x)"},
  };
}

std::vector<BrokenFile> broken_data() {
  const std::string points = "element vertex 2\n" + floats, data = "1 2 3\n4 5 6\n";
  return {
      {"TextCutOff", ascii(points, "1 2 3\n"),
       "5:1: it promises 2 of these, the file ends after 1 (vertex)"},
      {"TextPromisesTooMuch", ascii("element vertex 1000000000000\n" + floats, data),
       "it promises 1000000000000 of these, the file ends after 2 (vertex)"},
      {"ShortRow", ascii(points, "1 2 3\n4 5\n"), "11:4: the row ends before this column"},
      {"LongRow", ascii(points, "1 2 3 4\n4 5 6\n"), "10:7: the row goes on with '4'"},
      {"NoNumber", ascii(points, "1 2 3\n4 five 6\n"), "11:3: expected a number, found 'five' (y)"},
      {"TextNan", ascii(points, "1 2 3\n4 5 nan\n"), "11:5: expected a finite number"},
      {"NulByte", ascii(points, std::string("1 2 3\n4 5 \0\n", 11)), "11:5: expected a number"},
      {"TooLargeColour", ascii(points + "property uchar red\n", "1 2 3 4\n1 2 3 256\n"),
       "12:1: expected a number from 0 to 255 (red)"},
      {"BinaryCutOff", binary_points("2", std::string(23, 'a')),
       "5:1: it promises 2 of these, the file ends after 1 (vertex)"},
      {"BinaryPromisesTooMuch", binary_points("18446744073709551615", std::string(24, 'a')),
       "it promises 18446744073709551615 of these, the file ends after 2 (vertex)"},
      {"BinaryNan", with_nan(), "row 1: must be finite (y)"},
      {"ListBeforeIsTooLong",
       header("binary_big_endian", "element face 2\nproperty list uint double l\n" + points) +
           std::string(99, '\xff'),
       "5:1: it promises 2 of these, the file ends after 0 (face)"},
      {"NegativeList",
       header("binary_little_endian", "element face 2\nproperty list char char l\n" + points) +
           std::string(1, '\0') + std::string(99, '\xff'),
       "5:1: it promises 2 of these, the file ends after 1 (face)"},
  };
}

class BrokenPly : public testing::TestWithParam<BrokenFile> {};

TEST_P(BrokenPly, IsRefusedWithItsPlace) { test::expect_refused(GetParam(), "ply"); }

INSTANTIATE_TEST_SUITE_P(Headers, BrokenPly, testing::ValuesIn(broken_headers()),
                         test::broken_name);
INSTANTIATE_TEST_SUITE_P(Data, BrokenPly, testing::ValuesIn(broken_data()), test::broken_name);

}  // namespace
}  // namespace boule::ply
