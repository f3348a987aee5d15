#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>

#include "render/files/file/npz_member.h"
#include "tests/render/files/particle_file/read_text.h"
#include "tests/render/npy_files.h"

namespace boule {
namespace {

using test::append_bytes;
using test::npy_dict;
using test::npy_file;
using test::particle_error;
using test::read_particles;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two rows of a structured array with every kind of value.
std::string every_kind() {
  std::string data;
  for (const int i : {0, 1}) {
    for (const double x : {1.5 + i, 2.5, 1e300}) append_bytes(data, x);
    append_bytes(data, static_cast<std::int64_t>(-7 - i));
    append_bytes(data, std::uint8_t{200});
    append_bytes(data, static_cast<std::uint8_t>(i));  // a boolean
    data += std::string("\x40\x49\x0f\xdb", 4);        // pi as float32, big-endian
    data += "\x01\x02";                                // 258, big-endian
    data += i == 0 ? std::string("Fe\0", 3) : std::string("C\0\0", 3);
    append_bytes(data, std::uint32_t{0x3b1});  // alpha
    append_bytes(data, std::uint32_t{0});
    for (const float v : {1.0f, 2.0f, 3.0f}) append_bytes(data, v);
    data += "....";  // a gap
  }
  return npy_file(
      npy_dict("[('pos', '<f8', (3,)), ('id', '<i8'), ('byte', '|u1'), ('flag', '|b1'), "
               "('pi', '>f4'), ('short', '>i2'), ('element', '|S3'), ('greek', '<U2'), "
               "('velocity', '<f4', (3,)), ('', '|V4')]",
               "(2,)"),
      data);
}

double number(const ParticleFrame& frame, const std::string& name, std::size_t row) {
  const NumberColumn* column = find_number_column(frame, name);
  return column == nullptr ? std::numeric_limits<double>::quiet_NaN() : column->values.at(row);
}

TEST(NpyParticles, StructuredArrayHoldsColumnsOfEveryKind) {
  const auto read = read_particles("a.npy", every_kind());
  ASSERT_TRUE(read) << read.error().message;
  const ParticleFrame& frame = read.value();
  EXPECT_THAT(frame.positions, ElementsAre(Vec3d{1.5, 2.5, 1e300}, Vec3d{2.5, 2.5, 1e300}));
  EXPECT_EQ(number(frame, "id", 1), -8);
  EXPECT_EQ(number(frame, "byte", 0), 200);
  EXPECT_EQ(number(frame, "flag", 0), 0);
  EXPECT_EQ(number(frame, "flag", 1), 1);
  EXPECT_EQ(number(frame, "pi", 0), double{0x1.921fb6p+1f});
  EXPECT_EQ(number(frame, "short", 0), 258);
  EXPECT_EQ(number(frame, "vy", 1), 2);
  ASSERT_TRUE(frame.species);
  EXPECT_THAT(frame.species->texts, ElementsAre("Fe", "C"));
  EXPECT_THAT(frame.species->indices, ElementsAre(0, 1));
  ASSERT_EQ(frame.texts.size(), 1u);
  EXPECT_THAT(frame.texts[0].texts, ElementsAre("\xce\xb1"));
}

TEST(NpyParticles, FloatsOf16BitsAreExact) {
  struct Half {
    std::uint16_t bits;
    double number;
  };
  const Half halves[] = {
      {0x0000, 0},          {0x8000, -0.0},    {0x3c00, 1},        {0xc000, -2},
      {0x3555, 0x1.554p-2}, {0x7bff, 65504},   {0xfbff, -65504},   {0x0400, 0x1p-14},
      {0x03ff, 0x3ffp-24},  {0x0001, 0x1p-24}, {0x8001, -0x1p-24}, {0x3c01, 1 + 0x1p-10},
  };
  for (const char* order : {"<", ">"}) {
    std::string data;
    for (const Half& half : halves) {
      data += std::string(24, '\0');  // the position
      const char low = static_cast<char>(half.bits & 255), high = static_cast<char>(half.bits >> 8);
      data += *order == '<' ? std::string{low, high} : std::string{high, low};
    }
    const std::string fields = std::string("[('pos', '<f8', (3,)), ('v', '") + order + "f2')]";
    const auto read = read_particles("a.npy", npy_file(npy_dict(fields, "(12,)"), data));
    ASSERT_TRUE(read) << read.error().message;
    for (std::size_t i = 0; i < std::size(halves); ++i) {
      const double number_read = number(read.value(), "v", i);
      EXPECT_EQ(number_read, halves[i].number) << order << i;
      EXPECT_EQ(std::signbit(number_read), std::signbit(halves[i].number)) << order << i;
    }
  }
}

TEST(NpyParticles, OnlyWantedColumnsAreKept) {
  const ParticleFileOptions options{.wanted = std::vector<std::string>{"pi"}};
  const auto read = read_particles("a.npy", every_kind(), options);
  ASSERT_TRUE(read);
  ASSERT_EQ(read.value().numbers.size(), 1u);
  EXPECT_EQ(read.value().numbers[0].name, "pi");
  EXPECT_THAT(read.value().unread, testing::Contains("short"));
  EXPECT_TRUE(read.value().texts.empty());
  EXPECT_TRUE(read.value().species);
}

std::string rows_of_five() {
  std::string data;
  for (int i = 0; i < 10; ++i) append_bytes(data, static_cast<float>(i) / 4);
  return npy_file(npy_dict("'<f4'", "(2, 5)"), data);
}

TEST(NpyParticles, PlainRowsHaveUsualOrGivenNames) {
  const auto usual = read_particles("a.npy", rows_of_five());
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual.value().positions[1], (Vec3d{1.25, 1.5, 1.75}));
  EXPECT_EQ(number(usual.value(), "radius", 0), 0.75);
  EXPECT_EQ(number(usual.value(), "c5", 1), 2.25);
  const auto named =
      read_particles("a.npy", rows_of_five(), {.columns = {"type", "z", "y", "x", "mass"}});
  ASSERT_TRUE(named);
  EXPECT_EQ(named.value().positions[0], (Vec3d{0.75, 0.5, 0.25}));
  EXPECT_THAT(named.value().species->texts, ElementsAre("0", "1.25"));
  EXPECT_EQ(number(named.value(), "type", 1), 1.25);
}

std::string structured(const std::string& fields, const std::string& data,
                       const std::string& shape = "(1,)") {
  return npy_file(npy_dict(fields, shape), data);
}

TEST(NpyParticles, TooManyColumnsAreRefusedBeforeAllocation) {
  std::string fields = "[";
  for (int i = 0; i < 500; ++i) fields += "('f" + std::to_string(i) + "', '|u1', (65536,)), ";
  const auto read = read_particles("a.npy", structured(fields + "]", ""));
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("more than 131072 columns"));
  EXPECT_EQ(read.error().key, "f2");
}

TEST(NpyParticles, WrongFilesAreRefusedWithTheirColumn) {
  const std::string xyz(24, '\0'), position = "('pos', '<f8', (3,))";
  std::string infinite = xyz;
  append_bytes(infinite, std::numeric_limits<float>::infinity());
  struct Case {
    std::string fields, data, words;
  };
  const Case cases[] = {
      {"[" + position + ", ('v', '<f4')]", infinite, "row 0: must be finite (v)"},
      {"[" + position + ", ('v', '<c8')]", xyz + xyz, "holds '<c8', expected numbers"},
      {"[" + position + ", ('v', '<f16')]", xyz + xyz,
       "holds '<f16', expected numbers (f2, f4, f8, i, u, b) or texts (S, U) of a fixed width"},
      {"[" + position + ", ('v', '<f2')]", xyz + std::string("\x00\x7c", 2),
       "row 0: must be finite (v)"},
      {"[('x', '<f8'), ('y', '<f8'), ('z', '>f2')]", xyz.substr(8) + std::string("\xfe\x00", 2),
       "row 0: must be finite (z)"},
      {"[" + position + ", ('v', '|O')]", xyz + xyz, "holds '|O'"},
      {"[" + position + ", ('v', '<M8[s]')]", xyz + xyz, "holds '<M8[s]'"},
      {"[" + position + ", ('v', 'f4')]", xyz + xyz, "holds 'f4'"},
      {"[" + position + ", ('v', '<S99999999999')]", xyz, "holds '<S99999999999'"},
      {"[" + position + ", ('v', '<f4', (70000,))]", xyz, "unexpected value"},
      {"[" + position + ", ('v', '<f8', (65536,)), ('w', '<U60000', (65536,))]", xyz,
       "longer than 2^31 bytes (w)"},
      {"[" + position + ", ('x', '<f8')]", xyz + "12345678", "two columns have the name 'x'"},
      {"[('x', '<f8'), ('y', '<f8')]", xyz.substr(8), "no column of positions for z (z)"},
      {"[('x', '<f8'), ('y', '<f8'), ('z', '|S8')]", xyz, "no column of positions for z (z)"},
      {"[" + position + "]", xyz + xyz, "declares 1 rows of 24 bytes, but holds 48"},
      {"[" + position + "]", xyz.substr(1), "declares 1 rows of 24 bytes, but holds 23"},
      {"[]", xyz, "unexpected value"},
      {"[('', '|V24')]", xyz, "no column of positions for x"},
      {"[('x', '<f8')", xyz, "unexpected value"},
      {"[('x')]", xyz, "unexpected value"},
      {"[(('title', 'x'), '<f8')]", xyz, "unexpected value"},
      {"[('x', [('y', '<f8')])]", xyz, "unexpected value"},
      {"'<i4'", xyz, "has shape (1), expected (N, 3)"},
  };
  for (const Case& wrong : cases) {
    EXPECT_THAT(particle_error("a.npy", structured(wrong.fields, wrong.data)),
                HasSubstr(wrong.words));
  }
  EXPECT_THAT(particle_error("a.npy", structured("[" + position + "]", xyz, "(1, 1)")),
              HasSubstr("expected one dimension"));
  EXPECT_THAT(particle_error("a.npy", structured("[" + position + "]", xyz, "(1000000000000,)")),
              HasSubstr("declares 1000000000000 rows"));
  EXPECT_THAT(particle_error("a.npy", rows_of_five(), {.columns = {"x", "y"}}),
              HasSubstr("names 2 columns, the file has 5 (columns)"));
  EXPECT_THAT(particle_error("a.npy", every_kind().substr(0, 40)), HasSubstr("ends within"));
}

TEST(NpzName, IsAFileAndAnArray) {
  EXPECT_FALSE(npz_name("a.npy"));
  EXPECT_FALSE(npz_name("a.npy:b"));
  EXPECT_EQ(npz_name("a.npz")->array, "");
  EXPECT_EQ(npz_name("d:/a.npz:b")->file, "d:/a.npz");
  EXPECT_EQ(npz_name("d:/a.npz:b")->array, "b");
  EXPECT_TRUE(is_particle_name("d/a.npz:group/b"));
}

#ifdef BOULE_HAS_LIBZIP

/// A number of an archive: `size` bytes, the lowest first.
std::string zip_number(std::size_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
  return bytes;
}

/// An archive of the array "a", as it is, with a checksum of 0 (APPNOTE.TXT of PKWARE).
std::string archive_without_checksum(const std::string& array) {
  const std::string name = "a.npy";
  const std::string about = zip_number(20, 2) + std::string(12, '\0') +
                            zip_number(array.size(), 4) + zip_number(array.size(), 4) +
                            zip_number(name.size(), 2);
  const std::string local = "PK\3\4" + about + std::string(2, '\0') + name + array;
  const std::string entry = "PK\1\2" + zip_number(20, 2) + about + std::string(16, '\0') + name;
  return local + entry + "PK\5\6" + std::string(4, '\0') + zip_number(1, 2) + zip_number(1, 2) +
         zip_number(entry.size(), 4) + zip_number(local.size(), 4) + std::string(2, '\0');
}

const std::string archive = BOULE_TEST_DATA "/arrays.npz";

Result<ParticleFrame> read_array(const std::string& path) {
  auto file = ParticleFile::open(path);
  if (!file) return file.error();
  return file.value().read();
}

TEST(NpzParticles, AnArrayOfAnArchiveIsRead) {
  const auto atoms = read_array(archive + ":atoms");
  ASSERT_TRUE(atoms) << atoms.error().message;
  EXPECT_EQ(atoms.value().positions[1], (Vec3d{4.5, 5, 6}));
  EXPECT_THAT(atoms.value().species->texts, ElementsAre("C", "Fe"));
  EXPECT_EQ(number(atoms.value(), "mass", 1), 56);
  const auto centers = read_array(archive + ":centers");
  ASSERT_TRUE(centers);
  EXPECT_EQ(centers.value().size(), 2u);
}

TEST(NpzParticles, WhatIsWrongIsTold) {
  const auto message = [](const std::string& path) {
    const auto read = read_array(path);
    return read ? "no error" : read.error().message;
  };
  EXPECT_THAT(message(archive), HasSubstr("holds 3 arrays, name one"));
  EXPECT_THAT(message(archive), HasSubstr("'atoms', 'centers', 'words'"));
  EXPECT_THAT(message(archive + ":atmos"), HasSubstr("has no array 'atmos', it has 'atoms'"));
  EXPECT_THAT(message(archive + ":words"), HasSubstr("has shape (2)"));
  EXPECT_THAT(message("/nowhere/a.npz:b"), HasSubstr("No such file"));
  const test::TempDir folder;
  const std::string path = folder.path() / "a.npz";
  std::string bytes = test::read_bytes(archive);
  bytes[200] = static_cast<char>(bytes[200] ^ 1);  // in the first array
  test::write_bytes(path, bytes);
  EXPECT_THAT(message(path + ":atoms"), testing::Ne("no error"));
  EXPECT_THAT(message(path + ":atoms"), HasSubstr("is damaged: the array 'atoms' ends early or"));
  test::write_bytes(path, archive_without_checksum(rows_of_five()));
  EXPECT_EQ(message(path), "is damaged: its array ends early or does not match its checksum");
  test::write_bytes(path, "PK");
  EXPECT_THAT(message(path + ":atoms"), HasSubstr("not a readable .npz file"));
}

#endif

}  // namespace
}  // namespace boule
