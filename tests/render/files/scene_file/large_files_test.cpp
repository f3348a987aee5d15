#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <utility>

#include "render/files/file/input_file.h"
#include "render/files/file/npy_rows.h"
#include "render/files/file/sphere_room.h"
#include "render/files/scene_file/nff/nff_reader.h"
#include "render/files/scene_file/npy/npy_reader.h"
#include "tests/render/files/scene_file/scene_folder.h"
#include "tests/render/npy_files.h"

// What is read in blocks and without a look at single things: files of more than one block, and
// the borders of blocks.

namespace boule::large_files {
namespace {

using test::SceneFolder;

constexpr std::size_t text_block = std::size_t{1} << 18;
constexpr std::size_t row_block = 4096;

const std::string view = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 45\nresolution 8 8\n";

/// Text of this many bytes without a pattern that a shift by a block would keep.
std::string unlike_text(std::size_t size) {
  std::string text;
  for (std::size_t i = 0; text.size() < size; ++i) text += std::to_string(i * 7919) + "\n";
  return text.substr(0, size);
}

TEST(ReadText, AnyNumberOfBlocks) {
  for (const std::size_t blocks :
       {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
    for (const int more : {-1, 0, 1, 1000}) {
      if (blocks == 0 && more < 0) continue;
      const SceneFolder files;
      const std::string text = unlike_text(blocks * text_block + static_cast<std::size_t>(more));
      const auto read = read_text(files.write("a.nff", text));
      ASSERT_TRUE(read.ok());
      EXPECT_TRUE(read.value() == text) << blocks << " blocks and " << more;
    }
  }
}

TEST(ReadText, NulBytesKeepPlacesAtBlockBorders) {
  for (const std::size_t nul : {text_block - 1, text_block, 3 * text_block - 1, 3 * text_block}) {
    const SceneFolder files;
    std::string text(4 * text_block, '#');
    text[nul - 3] = '\n';
    text[nul] = '\0';
    const auto read = read_text(files.write("a.nff", text));
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().line, 2);
    EXPECT_EQ(read.error().column, 3);
  }
}

/// A hole of this many bytes, behind a text.
std::string sparse_file(const SceneFolder& files, const std::string& text, std::uintmax_t size) {
  std::string path = files.write("a.toml", text);
  std::filesystem::resize_file(path, size);
  return path;
}

TEST(ReadText, ZerosAreRefusedBeforeLargeAllocations) {
  const SceneFolder files;
  const auto read = read_text(sparse_file(files, "schema = 1\n", std::uintmax_t{1} << 42));
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, testing::HasSubstr("holds a NUL byte"));
  EXPECT_EQ(read.error().line, 2);
  EXPECT_EQ(read.error().column, 1);
}

/// How many bytes this process has read, or none where the system does not count them.
std::optional<std::uint64_t> bytes_read() {
  std::ifstream file("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  if (!(file >> name >> bytes) || name != "rchar:") return std::nullopt;
  return bytes;
}

TEST(ReadText, ReadingStopsAtTheBlockWithNul) {
  const SceneFolder files;
  const std::string text(3 * text_block, '#');
  const std::string path = sparse_file(files, text, 1000 * text_block);
  const auto before = bytes_read();
  const auto read = read_text(path);
  const auto after = bytes_read();
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, testing::HasSubstr("holds a NUL byte"));
  if (!before || !after) GTEST_SKIP() << "this system does not count what is read";
  EXPECT_LT(*after - *before, 5 * text_block);
}

/// The position and length of a number relative to a block's end do not matter: each place has
/// its turn, as does the end of the text.
TEST(LargeNff, NumbersAcrossTheBordersOfBlocks) {
  const std::string line = "s -1.25e1 3.5 +1024.0625 0.0625\r\n";
  for (std::size_t before = 0; before <= line.size(); ++before) {
    const std::size_t used = view.size() + before;
    const std::string text = view + "#" + std::string(text_block - used - 2, '-') + "\n" + line +
                             line.substr(0, line.size() - 2);
    SceneFileOptions options;
    options.origin = Vec3d{};
    const auto loaded = SceneFolder{}.load("a.nff", text, options);
    ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
    ASSERT_EQ(loaded.value().scene.spheres.size(), 2u);
    for (const Sphere& s : loaded.value().scene.spheres) {
      EXPECT_EQ(s.center, (Vec3f{-12.5f, 3.5f, 1024.0625f}));
      EXPECT_EQ(s.radius, 0.0625f);
    }
  }
}

TEST(LargeNff, FarErrorsHaveTheirPlace) {
  std::string text = view;
  for (int i = 0; i < 50000; ++i) text += "s 1 2 3 0.5\n";
  const auto loaded = SceneFolder{}.load("a.nff", text + "s 1 2 3 -0.5");
  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().line, 50007);
  EXPECT_EQ(loaded.error().column, 9);
  EXPECT_EQ(loaded.error().key, "s.radius");
}

TEST(LargeNff, FillsBetweenManySpheres) {
  std::string text = view;
  for (int i = 0; i < 30000; ++i) {
    if (i % 1000 == 0) text += "f 1 0.5 0.25 1 0 0 0 1\n";
    text += "s " + std::to_string(i) + " 0 0 1\n";
  }
  const auto loaded = SceneFolder{}.load("a.nff", text);
  ASSERT_TRUE(loaded.ok());
  const std::vector<Sphere>& spheres = loaded.value().scene.spheres;
  ASSERT_EQ(spheres.size(), 30000u);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    ASSERT_EQ(spheres[i].center.x, static_cast<float>(i));
    ASSERT_EQ(spheres[i].material, i / 1000);
  }
}

/// A '+' that belongs to what follows it.
bool has_plus(const std::string& word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-';
}

/// The number that a whole word is, as from_chars and the rules of floats have it; NaN for none.
double number_of(const std::string& word) {
  const std::string text = has_plus(word) ? word.substr(1) : word;
  double number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = code == std::errc{} && end == text.data() + text.size();
  const bool fits = std::fabs(number) <= static_cast<double>(std::numeric_limits<float>::max());
  return is_number && fits ? number : std::nan("");
}

/// Words that begin like numbers, between other blanks than spaces.
TEST(LargeNff, NumbersAreWholeWords) {
  std::mt19937 random(11);
  const std::string characters = "0123456789012345678901234567890123456789..--+eE#xainf";
  int good = 0, bad = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string word(1 + random() % 4, ' ');
    for (char& c : word) c = characters[random() % characters.size()];
    if (word[0] == '#') continue;
    const double number = number_of(word);
    const auto loaded =
        read_nff(view + "s\t" + word + "\v0\f0 1", "a.nff", PolygonPolicy::plane, Vec3d{});
    ASSERT_EQ(loaded.ok(), !std::isnan(number)) << word;
    if (loaded) {
      ++good;
      EXPECT_EQ(loaded.value().scene.spheres[0].center.x, static_cast<float>(number));
    } else {
      ++bad;
      EXPECT_EQ(loaded.error().column, has_plus(word) ? 4 : 3) << word;
    }
  }
  EXPECT_GT(good, 5000);
  EXPECT_GT(bad, 5000);
}

/// What printf makes of a float, in 9 digits and in any number of them, is that float again.
TEST(LargeNff, PrintedFloatsComeBack) {
  std::mt19937 random(12);
  std::string text = view;
  std::vector<float> expected;
  for (int i = 0; i < 20000; ++i) {
    float x = 0;
    const auto bits = static_cast<std::uint32_t>(random());
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x)) continue;
    char line[128];
    std::snprintf(line, sizeof line, "s %.9g %.8e %+.*g 1\n", static_cast<double>(x),
                  static_cast<double>(x), 9 + i % 40, static_cast<double>(x));
    text += line;
    expected.push_back(x);
  }
  const auto loaded = SceneFolder{}.load("a.nff", text);
  ASSERT_TRUE(loaded.ok()) << format_diagnostic(loaded.error());
  ASSERT_EQ(loaded.value().scene.spheres.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Vec3f& center = loaded.value().scene.spheres[i].center;
    EXPECT_EQ(center, (Vec3f{expected[i], expected[i], expected[i]}));
  }
}

template <class Number>
std::string npy_of(const std::vector<Number>& numbers, std::size_t columns) {
  std::string data;
  for (const Number x : numbers) test::append_bytes(data, x);
  const std::string shape =
      "(" + std::to_string(numbers.size() / columns) + ", " + std::to_string(columns) + ")";
  return test::npy_file(test::npy_dict(sizeof(Number) == 4 ? "'<f4'" : "'<f8'", shape), data);
}

/// Numbers whose rows are spheres: any bits that a float can be, from some that are rounded.
template <class Number>
std::vector<Number> random_rows(std::size_t rows, std::size_t columns) {
  std::mt19937_64 random(13);
  std::vector<Number> numbers;
  while (numbers.size() < rows * columns) {
    Number x = 0;
    const std::uint64_t bits = random();
    std::memcpy(&x, &bits, sizeof x);
    if (!(std::fabs(x) <= static_cast<Number>(std::numeric_limits<float>::max()))) continue;
    const bool is_radius = columns == 4 && numbers.size() % 4 == 3;
    if (is_radius && !(static_cast<float>(std::fabs(x)) > 0)) continue;
    numbers.push_back(is_radius ? std::fabs(x) : x);
  }
  return numbers;
}

template <class Number>
void expect_read(std::size_t rows, std::size_t columns) {
  const SceneFolder files;
  const std::vector<Number> numbers = random_rows<Number>(rows, columns);
  NpySpheres request{files.write("a.npy", npy_of(numbers, columns)), {}, 7};
  if (columns == 3) request.radius = 0.25f;
  std::vector<Sphere> spheres(2);
  ASSERT_TRUE(append_spheres(request, spheres));
  ASSERT_EQ(spheres.size(), rows + 2);
  for (std::size_t i = 0; i < rows; ++i) {
    const Sphere& s = spheres[i + 2];
    const auto number = [&](std::size_t k) { return static_cast<float>(numbers[i * columns + k]); };
    ASSERT_EQ(s.center, (Vec3f{number(0), number(1), number(2)})) << i;
    ASSERT_EQ(s.radius, columns == 4 ? number(3) : 0.25f) << i;
    ASSERT_EQ(s.material, 7u);
  }
}

TEST(LargeNpy, ReadsEveryRowAcrossBlockBorders) {
  for (const std::size_t rows : {row_block - 1, row_block, row_block + 1, 2 * row_block + 17}) {
    for (const std::size_t columns : {std::size_t{3}, std::size_t{4}}) {
      expect_read<float>(rows, columns);
      expect_read<double>(rows, columns);
    }
  }
}

/// The first bad row is named, at either side of a border, and nothing is left of the others.
template <class Number>
void expect_named(std::size_t bad_row) {
  std::vector<Number> numbers(4 * 3 * row_block, 1);
  numbers[4 * bad_row + 3] = -1;
  numbers[4 * (bad_row + 1) + 1] = std::numeric_limits<Number>::infinity();
  const SceneFolder files;
  std::vector<Sphere> spheres(2);
  const auto done = append_spheres({files.write("a.npy", npy_of(numbers, 4)), {}, 0}, spheres);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message,
            "row " + std::to_string(bad_row) + ": radius must be finite and above 0, is -1");
  EXPECT_EQ(spheres.size(), 2u);
}

TEST(LargeNpy, TheFirstBadRowIsNamed) {
  for (const std::size_t row : {std::size_t{0}, row_block - 1, row_block, 3 * row_block - 2}) {
    expect_named<float>(row);
    expect_named<double>(row);
  }
}

TEST(LargeNpy, BadCommonRadiusIsRefused) {
  const SceneFolder files;
  const std::string path = files.write("a.npy", npy_of<float>({1, 2, 3}, 3));
  for (const float radius : {0.0f, -1.0f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
    std::vector<Sphere> spheres;
    const auto done = append_spheres({path, radius, 0}, spheres);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message,
                testing::StartsWith("row 0: radius must be finite and above 0, is "));
  }
}

TEST(LargeNpy, AFileThatBecomesShorterIsRefused) {
  const SceneFolder files;
  const std::string path = files.write("a.npy", std::string(100, 'x'));
  auto file = InputFile::open(path);
  ASSERT_TRUE(file.ok());
  ASSERT_EQ(truncate(path.c_str(), 40), 0);
  unsigned char rows[64] = {};
  EXPECT_TRUE(read_npy_rows(file.value(), rows, 32));
  const auto done = read_npy_rows(file.value(), rows, 32);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "became shorter while it was read");
}

/// Only some file systems have room for such a file, all holes: more spheres than a vector holds.
TEST(LargeNpy, TooManyRowsAreRefused) {
  const std::string memory = "/dev/shm", stem = "boule-test-" + std::to_string(getpid());
  const std::string npy = memory + "/" + stem + ".npy", scene = memory + "/" + stem + ".toml";
  const std::string rows = "500000000000000000";
  std::ofstream(npy, std::ios::binary)
      << test::npy_file(test::npy_dict("'<f4'", "(" + rows + ", 4)"), "");
  std::ofstream(scene) << "schema = 1\n[[spheres]]\nfile = \"" << stem << ".npy\"\n";
  const bool has_room = truncate(npy.c_str(), 128 + 16 * std::stoll(rows)) == 0;
  const auto loaded = load_scene(scene);
  std::filesystem::remove(npy), std::filesystem::remove(scene);
  if (!has_room) GTEST_SKIP() << memory << " has no files of 8 exabytes";
  ASSERT_FALSE(loaded.ok());
  EXPECT_THAT(loaded.error().message,
              testing::HasSubstr("'" + stem + ".npy': " + rows + " spheres need "));
}

TEST(SphereRoom, GrowsByHalfAndKeepsItsSpheres) {
  std::vector<Sphere> spheres;
  make_room(spheres, 1'000'000);
  EXPECT_EQ(spheres.capacity(), 1'000'000u);
  for (int i = 0; i < 1'000'000; ++i) spheres.push_back({{static_cast<float>(i), 0, 0}, 1, 3});
  make_room(spheres, 1);
  EXPECT_EQ(spheres.capacity(), 1'500'000u);
  make_room(spheres, 500'000);
  EXPECT_EQ(spheres.capacity(), 1'500'000u);
  ASSERT_EQ(spheres.size(), 1'000'000u);
  for (int i = 0; i < 1'000'000; ++i) {
    ASSERT_EQ(spheres[static_cast<std::size_t>(i)].center.x, static_cast<float>(i));
  }
}

}  // namespace
}  // namespace boule::large_files
