// What write_image() refuses and survives. image_content_test.cpp reads back what it writes.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <ctime>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "render/image/finished_picture.h"
#include "render/image/module/module_loader.h"
#include "render/image/read_image.h"
#include "render/image/write_image.h"
#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

constexpr const char* extensions[] = {"exr",  "hdr",  "png", "jpg", "jpeg", "tif",
                                      "tiff", "webp", "ppm", "pnm", "bmp",  "tga"};

class WriteImage : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const {
    return (dir_.path() / name).string();
  }
  [[nodiscard]] Names names() const { return test::names_in(dir_.path()); }
  /// The text after "cannot write 'NAME': ", or empty for a success.
  static std::string reason(const Image& image, const std::string& path,
                            const ImageFileOptions& options = {}) {
    const Status done = write_image(image, path, options);
    if (done) return {};
    const std::string start = "cannot write '" + path + "': ";
    EXPECT_TRUE(done.error().message.starts_with(start)) << done.error().message;
    return done.error().message.substr(std::min(start.size(), done.error().message.size()));
  }

 private:
  test::TempDir dir_;
};

TEST_F(WriteImage, EqualPicturesAreEqualFiles) {
  const Image image = test::noise(70, 130);
  for (const std::string extension : extensions) {
    ASSERT_EQ(reason(image, at("one." + extension)), "");
  }
  // A time stamp would differ after a second.
  const std::time_t second = std::time(nullptr);
  while (std::time(nullptr) == second) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (const std::string extension : extensions) {
    ASSERT_EQ(reason(image, at("two." + extension)), "");
    const std::string bytes = test::read_bytes(at("one." + extension));
    EXPECT_GT(bytes.size(), 1000U);
    EXPECT_TRUE(bytes == test::read_bytes(at("two." + extension))) << extension;
  }
  EXPECT_EQ(names().size(), 2 * std::size(extensions));
}

/// The number of threads of this process. One that was joined may be listed a little longer, but
/// with the flag PF_EXITING in the ninth field of "NUMBER (NAME) STATE ...".
std::size_t count_threads() {
  constexpr unsigned long exiting = 4;
  std::size_t count = 0;
  for (const std::string& thread : test::names_in("/proc/self/task")) {
    const std::string text = test::read_bytes("/proc/self/task/" + thread + "/stat");
    std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::string skipped;
    for (int field = 3; field < 9; ++field) fields >> skipped;
    unsigned long flags = exiting;
    fields >> flags;
    count += (flags & exiting) == 0 ? 1 : 0;
  }
  return count;
}

TEST_F(WriteImage, ThreadsDoNotChangeTheFile) {
  const Image image = test::noise(100, 300);
  ImageFileOptions options;
  // Loading brings in log4cplus (a dependency's dependency), which starts four threads of its own.
  ASSERT_TRUE(load_image_module(*find_image_format("a.tif")).ok());
  const std::size_t threads_loaded = count_threads();
  ASSERT_EQ(reason(image, at("one.exr"), options), "");
  EXPECT_EQ(count_threads(), threads_loaded) << "one is the caller's";
  options.threads = 4;
  ASSERT_EQ(reason(image, at("four.exr"), options), "");
  EXPECT_TRUE(test::read_bytes(at("one.exr")) == test::read_bytes(at("four.exr")));
}

/// A TIFF has strips of 32 rows, which several threads pack: each must come in one piece.
TEST_F(WriteImage, ThreadsDoNotChangeTallTiffs) {
  const Image image = test::noise(3000, 300);
  ImageFileOptions options;
  ASSERT_EQ(reason(image, at("one.tif"), options), "");
  for (const int threads : {2, 7, 16}) {
    options.threads = threads;
    ASSERT_EQ(reason(image, at("more.tif"), options), "") << threads;
    EXPECT_TRUE(test::read_bytes(at("one.tif")) == test::read_bytes(at("more.tif"))) << threads;
  }
}

TEST_F(WriteImage, FullDiskKeepsTheOldFile) {
  const Image image = test::noise(64, 64);
  for (const std::string extension : extensions) {
    const std::string path = at("a." + extension);
    test::write_bytes(path, "old");
    {
      const test::FileSizeLimit limit(700);
      EXPECT_EQ(reason(image, path), "File too large") << extension;
    }
    EXPECT_EQ(test::read_bytes(path), "old") << extension;
  }
  EXPECT_EQ(names().size(), std::size(extensions));
}

TEST_F(WriteImage, FullDeviceIsReported) {
  for (const std::string extension : extensions) {
    fs::create_symlink("/dev/full", at("full." + extension));
    fs::create_symlink("/dev/null", at("null." + extension));
    EXPECT_EQ(reason(test::noise(9, 7), at("full." + extension)), "No space left on device");
    EXPECT_EQ(reason(test::noise(9, 7), at("null." + extension)), "");
  }
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(WriteImage, StopLeavesNothing) {
  test::write_bytes(at("a.exr"), "old");
  ImageFileOptions options;
  int asked = 0;
  options.stop = [&asked] { return ++asked == 2; };
  EXPECT_EQ(reason(test::noise(16, 1000), at("a.exr"), options), "interrupted");
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(names(), Names{"a.exr"});
  EXPECT_EQ(test::read_bytes(at("a.exr")), "old");
}

TEST_F(WriteImage, UnwritableTargetsAreRefused) {
  const Image image(4, 4);
  fs::create_directory(at("dir.png"));
  EXPECT_EQ(reason(image, at("dir.png")), "Is a directory");
  EXPECT_EQ(reason(image, at("missing/a.png")), "No such file or directory");
  EXPECT_EQ(reason(image, at(std::string(252, 'n') + ".png")), "File name too long");
  for (const char* name : {"a", "a.gif", ".png", "a.", "png"}) {
    EXPECT_TRUE(reason(image, at(name)).starts_with("unknown image extension, expected one of exr"))
        << name;
  }
  EXPECT_EQ(names(), Names{"dir.png"});
}

TEST_F(WriteImage, InvalidPicturesAreRefused) {
  Image torn(4, 4);
  torn.pixels.pop_back();
  for (const Image& image : {Image(), Image(0, 4), torn}) {
    EXPECT_EQ(reason(image, at("a.png")), "the picture has no pixels");
  }
  EXPECT_EQ(names(), Names{});
}

TEST_F(WriteImage, TooWideForTheFormat) {
  constexpr std::pair<const char*, int> cases[] = {{"webp", 16383}, {"jpg", 65500}, {"tga", 65535}};
  for (const auto& [extension, longest] : cases) {
    const std::string path = at(std::string("a.") + extension);
    const std::string limit = std::string("a .") + extension + " file has at most " +
                              std::to_string(longest) + " pixels a side";
    EXPECT_EQ(reason(Image(longest + 1, 1), path), limit);
    EXPECT_EQ(reason(Image(1, longest + 1), path), limit);
    EXPECT_EQ(reason(Image(longest, 1), path), "");
    EXPECT_EQ(reason(Image(1, longest), path), "");
    std::filesystem::remove(path);
  }
  EXPECT_EQ(names(), Names{});
}

TEST_F(WriteImage, CropsOutsideTheirFrame) {
  for (const CropWindow crop : {CropWindow{3, 9, 0, 0},
                                {9, 3, 0, 0},
                                {9, 9, 6, 0},
                                {9, 9, 0, 6},
                                {9, 9, -1, 0},
                                {9, 9, 0, -1},
                                {-9, 9, 0, 0}}) {
    ImageFileOptions options;
    options.crop = crop;
    EXPECT_EQ(reason(Image(4, 4), at("a.exr"), options), "the crop lies outside its frame");
  }
  EXPECT_EQ(names(), Names{});
}

TEST_F(WriteImage, ChannelsThatDoNotFit) {
  ImageFileOptions options;
  options.channels = {{"Z", std::vector<float>(16)}};
  EXPECT_EQ(reason(Image(4, 4), at("a.png"), options),
            "a .png file has no room for extra channels");
  EXPECT_EQ(reason(Image(4, 5), at("a.exr"), options), "channel 'Z' has not one sample per pixel");
  for (const char* name : {"", "R", "B"}) {
    options.channels[0].name = name;
    EXPECT_EQ(reason(Image(4, 4), at("a.exr"), options),
              "channel '" + std::string(name) + "' has no name of its own");
  }
  options.channels = {{"id", std::vector<std::uint32_t>(16)}, {"id", std::vector<float>(16)}};
  EXPECT_EQ(reason(Image(4, 4), at("a.exr"), options), "channel 'id' has no name of its own");
  EXPECT_EQ(names(), Names{});
}

TEST_F(WriteImage, NamesWithNulBytes) {
  const std::string name = at("a") + std::string("\0.png", 5);
  EXPECT_FALSE(write_image(test::noise(4, 3), name));
  EXPECT_EQ(names(), Names{});
  ASSERT_EQ(reason(test::noise(4, 3), at("a.png")), "");
  const std::string longer = at("a.png") + std::string("\0.png", 5);
  EXPECT_EQ(read_image(longer, PictureContent::colors).error().message,
            "cannot read it: its name holds a NUL byte");
  EXPECT_FALSE(is_finished_picture(longer, {4, 3, {}}));
}

/// Libraries below print: libpng does so about a file without pixels.
class Silence {
 public:
  Silence() { testing::internal::CaptureStderr(); }
  ~Silence() { EXPECT_EQ(testing::internal::GetCapturedStderr(), ""); }
};

TEST_F(WriteImage, StoppingIsSilent) {
  const Silence silence;
  for (const std::string extension : extensions) {
    for (const int side : {1, 700}) {
      for (int after = 0; after < 3; ++after) {
        ImageFileOptions options;
        int asked = 0;
        options.stop = [&] { return asked++ == after; };
        const std::string why = reason(Image(side, side), at("a." + extension), options);
        EXPECT_EQ(why, asked > after ? "interrupted" : "");
      }
    }
  }
}

TEST_F(WriteImage, ExceptionsOfCallbacksAreTheReason) {
  const Silence silence;
  for (const std::string extension : {"png", "exr"}) {
    ImageFileOptions options;
    int calls = 0;
    options.stop = [&calls]() -> bool {
      throw std::runtime_error("no " + std::to_string(++calls));
    };
    EXPECT_EQ(reason(test::noise(70, 130), at("a." + extension), options), "no 1");
    options.stop = [] { return false; };
    options.temporary = [](const std::string&) { throw 7; };
    EXPECT_EQ(reason(test::noise(4, 3), at("a." + extension), options), "an unknown exception");
    EXPECT_EQ(names(), Names{});
  }
}

TEST_F(WriteImage, ExcessiveNumbersAreBounded) {
  constexpr auto nan = std::numeric_limits<float>::quiet_NaN();
  constexpr auto inf = std::numeric_limits<float>::infinity();
  const Silence silence;
  Image image(4, 3);
  for (Color& c : image.pixels) c = {nan, inf, -inf};
  ImageFileOptions options;
  for (const int threads : {INT_MIN, 0, INT_MAX}) {
    for (const float stops : {nan, inf, -inf}) {
      for (const std::string extension : extensions) {
        options.threads = threads;
        options.exposure_stops = stops;
        options.compression = static_cast<Compression>(9);
        options.metadata = {
            {"", 1}, {"DateTime", 7}, {"odd", nan}, {"text", std::string("\0a", 2)}};
        EXPECT_EQ(reason(image, at("a." + extension), options), "") << threads << stops;
      }
    }
  }
}

TEST_F(WriteImage, AcceptsNamesOfAnyAlphabet) {
  EXPECT_EQ(reason(Image(4, 4), at("b\xc3\xa4ll # 0001.png")), "");
  EXPECT_EQ(names(), Names{"b\xc3\xa4ll # 0001.png"});
}

/// The check after writing must notice a file that lost its end. (It notices a PNG file as well,
/// but there libpng jumps over OpenImageIO's message, which the leak checker reports.)
TEST_F(WriteImage, CheckFindsTruncatedFiles) {
  const auto loaded = load_image_module(*find_image_format("a.tif"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  const image_module::Table* const table = loaded.value().table;
  std::vector<unsigned char> bytes(40 * 40 * 4);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * i / 7);
  const std::pair<const char*, image_module::SampleType> formats[] = {
      {"openexr", image_module::SampleType::f32},
      {"tiff", image_module::SampleType::u8},
      {"pnm", image_module::SampleType::u8},
      {"targa", image_module::SampleType::u8},
      {"bmp", image_module::SampleType::u8}};
  for (const auto& [format, type] : formats) {
    using image_module::Channel, image_module::Outcome;
    const Channel channels[] = {{"R", type}, {"G", type}, {"B", type}};
    const image_module::Samples samples[] = {
        {bytes.data(), 4}, {bytes.data(), 4}, {bytes.data(), 4}};
    const image_module::Picture picture{
        format, 40, 40, 0, 0, 40, 40, channels, 3, nullptr, 0, 1, [](const void*) { return false; },
        nullptr};
    test::write_bytes(at("a"), "");
    const int descriptor = open(at("a").c_str(), O_RDWR);
    image_module::Report report{};
    image_module::Writer* const writer = table->open(&picture, descriptor, &report);
    ASSERT_NE(writer, nullptr) << format << report.text;
    table->put(writer, samples, 40, &report);
    ASSERT_EQ(report.outcome, Outcome::done) << format << report.text;
    table->close(writer, &report);
    close(descriptor);
    ASSERT_EQ(report.outcome, Outcome::done) << format << report.text;
    table->check(&picture, at("a").c_str(), &report);
    EXPECT_EQ(report.outcome, Outcome::done) << format << report.text;
    fs::resize_file(at("a"), fs::file_size(at("a")) * 3 / 4);
    table->check(&picture, at("a").c_str(), &report);
    EXPECT_EQ(report.outcome, Outcome::failed) << format;
  }
}

}  // namespace
}  // namespace boule
