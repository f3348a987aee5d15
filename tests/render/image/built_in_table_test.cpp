// The files that are written without OpenImageIO, beside those that it writes.
#include "render/image/built_in_table.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "render/image/image_plan.h"
#include "render/image/module/module_loader.h"
#include "tests/render/image/files.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

using image_module::Outcome;
using image_module::Report;
using image_module::Table;

/// Codes of a picture without any order, row by row.
std::vector<std::uint8_t> random_codes(std::size_t count) {
  std::vector<std::uint8_t> codes(count);
  std::uint32_t state = 1;
  for (std::uint8_t& code : codes) {
    state = state * 1664525U + 1013904223U;
    code = static_cast<std::uint8_t>(state >> 28 << 2);
  }
  return codes;
}

class BuiltInTable : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const {
    return (dir_.path() / name).string();
  }
  /// Writes a picture by a table, `band` rows at a time, and checks it.
  static void write(const Table& table, const ImageForm& form, const std::string& path,
                    const ImageFileOptions& options, int band) {
    const auto plan = make_plan(form, path, options, find_image_format(path));
    ASSERT_TRUE(plan);
    const image_module::Picture& picture = plan.value()->picture;
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
    Report report{};
    auto* const writer = table.open(&picture, file, &report);
    ASSERT_NE(writer, nullptr) << report.text;
    const std::size_t channels = picture.channel_count;
    const auto codes = random_codes(static_cast<std::size_t>(form.width * form.height) * channels);
    for (int row = 0; row < form.height; row += band) {
      const int rows = std::min(band, form.height - row);
      std::vector<image_module::Samples> samples;
      for (std::size_t c = 0; c < channels; ++c) {
        const auto first = static_cast<std::size_t>(row * form.width) * channels + c;
        samples.push_back({codes.data() + first, channels});
      }
      table.put(writer, samples.data(), rows, &report);
      ASSERT_EQ(report.outcome, Outcome::done) << report.text;
    }
    table.close(writer, &report);
    ASSERT_EQ(report.outcome, Outcome::done) << report.text;
    ::close(file);
    table.check(&picture, path.c_str(), &report);
    EXPECT_EQ(report.outcome, Outcome::done) << report.text;
  }

  TempDir dir_;
};

const ImageForm forms[] = {{.width = 1, .height = 1, .alpha = Alpha::none, .channels = {}},
                           {.width = 333, .height = 177, .alpha = Alpha::none, .channels = {}},
                           {.width = 333, .height = 177, .alpha = Alpha::coverage, .channels = {}},
                           {.width = 5000, .height = 3, .alpha = Alpha::none, .channels = {}}};

TEST_F(BuiltInTable, WritesTheFilesOfOpenImageIo) {
  ImageFileOptions plain, told;
  told.date_time = "2026:11:26 12:34:56";
  told.metadata = {{"ImageDescription", std::string("partial: ä, 3 % of it")},
                   {"boule:solver", std::string("robust")},
                   {"boule:seed", 7},
                   {"Software", std::string("another")},
                   {"boule:twice", std::string("one")},
                   {"boule:twice", std::string("two")},
                   {"Artist", std::string("A. N. Other")},
                   {"DocumentName", std::string("Spheres")},
                   {"boule:long", std::string(100'000, 'x')}};
  told.crop.x = 3;
  told.crop.y = 4;
  told.crop.frame_width = 6000;
  told.crop.frame_height = 300;
  for (const char* extension : {"png", "ppm"}) {
    const ImageFormat& format = *find_image_format(std::string("a.") + extension);
    const Table* const own = built_in_table(format);
    if (own == nullptr) continue;  // built without libpng
    const auto other = load_image_module(format);
    ASSERT_TRUE(other);
    for (const ImageForm& form : forms) {
      if (form.alpha != Alpha::none && !format.alpha) continue;
      for (const ImageFileOptions& options : {plain, told}) {
        const std::string ours = at(std::string("ours.") + extension);
        const std::string theirs = at(std::string("theirs.") + extension);
        write(*own, form, ours, options, 50);
        write(*other.value().table, form, theirs, options, form.height);
        EXPECT_TRUE(read_bytes(ours) == read_bytes(theirs)) << extension << ", " << form.width;
      }
    }
  }
}

/// A file of another size, a shorter and a longer one, and one that is not there.
TEST_F(BuiltInTable, ChecksWhatWasWritten) {
  const ImageForm &form = forms[1], &wider = forms[3];
  for (const char* extension : {"png", "ppm"}) {
    const std::string path = at(std::string("a.") + extension);
    const ImageFormat& format = *find_image_format(path);
    const Table* const table = built_in_table(format);
    if (table == nullptr) continue;
    write(*table, form, path, {}, form.height);
    const auto outcome = [&](const ImageForm& wanted) {
      const auto plan = make_plan(wanted, path, {}, &format);
      Report report{};
      table->check(&plan.value()->picture, path.c_str(), &report);
      return report.outcome;
    };
    const std::string whole = read_bytes(path);
    EXPECT_EQ(outcome(form), Outcome::done);
    EXPECT_EQ(outcome(wider), Outcome::failed);
    for (const std::size_t left : {std::size_t{0}, std::size_t{10}, whole.size() - 5}) {
      ASSERT_EQ(::truncate(path.c_str(), static_cast<off_t>(left)), 0);
      EXPECT_EQ(outcome(form), Outcome::failed) << left;
    }
    ASSERT_EQ(::unlink(path.c_str()), 0);
    EXPECT_EQ(outcome(form), Outcome::system_error);
  }
}

/// A failure of the file is told with its code, an end that was asked for as such.
TEST_F(BuiltInTable, TellsWhatStopsIt) {
  const ImageForm form{.width = 1000, .height = 2000, .alpha = Alpha::none, .channels = {}};
  for (const char* extension : {"png", "ppm"}) {
    const std::string path = at(std::string("a.") + extension);
    const ImageFormat& format = *find_image_format(path);
    const Table* const table = built_in_table(format);
    if (table == nullptr) continue;
    const auto codes = random_codes(6'000'000);
    const image_module::Samples samples[] = {
        {codes.data(), 3}, {codes.data() + 1, 3}, {codes.data() + 2, 3}};
    const auto outcome = [&](const char* file_name, const ImageFileOptions& options) {
      const auto plan = make_plan(form, path, options, &format);
      const int file = ::open(file_name, O_RDWR | O_CREAT, 0600);
      Report report{}, ignored{};
      auto* const writer = table->open(&plan.value()->picture, file, &report);
      table->put(writer, samples, form.height, &report);
      table->close(writer, &ignored);
      ::close(file);
      EXPECT_EQ(report.code, report.outcome == Outcome::system_error ? ENOSPC : 0);
      return report.outcome;
    };
    ImageFileOptions stopped;
    stopped.stop = [] { return true; };
    EXPECT_EQ(outcome("/dev/full", {}), Outcome::system_error) << extension;
    EXPECT_EQ(outcome(path.c_str(), stopped), Outcome::stopped) << extension;
    EXPECT_EQ(outcome(path.c_str(), {}), Outcome::done) << extension;
  }
}

}  // namespace
}  // namespace boule::test
