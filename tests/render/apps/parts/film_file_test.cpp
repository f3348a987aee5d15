// Film files: what is written is read, and nothing else is taken for one.
#include "render/apps/parts/film_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule::test {
namespace {

using testing::HasSubstr;

class FilmFile : public testing::Test {
 protected:
  FilmFile() {
    head_.facts = {{"version", "1"}, {"scene", "abc"}};
    head_.share = {{"shard", "1/2"}};
    head_.metadata = {{"text", std::string("words")}, {"number", 7}, {"real", 0.1F}};
    MetadataMatrix matrix{};
    for (std::size_t i = 0; i < matrix.size(); ++i) matrix[i] = 1.0F / static_cast<float>(i + 3);
    head_.metadata.emplace_back("matrix", matrix);
    head_.frame_width = 50;
    head_.frame_height = 40;
    head_.rect = {3, 4, 43, 34};
    head_.spp = 9;
    head_.transparent = true;
    head_.order = PixelOrder::frameless;
    head_.kinds.outline = true;
    head_.kinds.aovs.depth = head_.kinds.aovs.id = true;
    head_.blocks = {{3, 4, 19, 20}, {30, 20, 43, 34}};
  }
  /// Every number of the blocks is another one.
  PartSheet filled() const {
    PartSheet sheet(head_.rect, head_.kinds);
    for (const PixelRect& block : head_.blocks) {
      std::string text;
      for (std::uint64_t i = 0; i < block.area(); ++i) {
        const FilmPixel pixel{0.1 * static_cast<double>(i), 3, 1e300, 9, 4};
        text.append(reinterpret_cast<const char*>(&pixel), sizeof pixel);
      }
      for (std::uint64_t i = 0; i < block.area(); ++i) text += static_cast<char>(i % 17);
      for (std::uint64_t i = 0; i < 2 * block.area(); ++i) {
        const auto number = static_cast<std::uint32_t>(i);
        text.append(reinterpret_cast<const char*>(&number), sizeof number);
      }
      EXPECT_TRUE(sheet.take(block, text));
    }
    return sheet;
  }
  std::string written() const {
    EXPECT_TRUE(film_file::write(path_, head_, filled(), {}));
    return read_bytes(path_);
  }
  std::string refusal(const std::string& bytes) const {
    write_bytes(path_, bytes);
    const auto reader = film_file::Reader::open(path_);
    if (reader) return "";
    EXPECT_EQ(reader.error().file, path_);
    return reader.error().message;
  }

  TempDir folder_;
  std::string path_ = (folder_.path() / "a.film").string();
  FilmHead head_;
};

TEST_F(FilmFile, HoldsMeasuredPixelsToo) {
  head_.kinds = {};
  head_.kinds.measured = true;
  head_.blocks = {{3, 4, 19, 20}};
  PartSheet sheet(head_.rect, head_.kinds);
  sheet.measured().at(5, 6) = {{1, 2, 3}, 0.5F, 0.25F, 77};
  EXPECT_EQ(sheet.least_samples({5, 6, 6, 7}), 77);
  EXPECT_TRUE(sheet.is_finished({5, 6, 6, 7}, 1000));
  EXPECT_FALSE(sheet.is_finished(head_.blocks[0], 1000));
  EXPECT_EQ(sheet.done(), 1U);
  EXPECT_EQ(sheet.all({{5, 6, 6, 7}, {6, 6, 7, 7}}, 1000), 2U);
  ASSERT_TRUE(film_file::write(path_, head_, sheet, {}));
  const auto reader = film_file::Reader::open(path_);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_TRUE(reader.value().head().kinds.measured);
  PartSheet found(head_.rect, head_.kinds);
  EXPECT_TRUE(reader.value().read(found));
  const MeasuredPixel pixel = found.measured().at(5, 6);
  EXPECT_EQ(pixel.color, (Color{1, 2, 3}));
  EXPECT_EQ(pixel.alpha, 0.5F);
  EXPECT_EQ(pixel.noise, 0.25F);
  EXPECT_EQ(pixel.samples, 77U);
  EXPECT_EQ(found.measured().at(6, 6).samples, 0U);
  sheet.measured().at(5, 6).noise = -1;  // which cannot be
  ASSERT_TRUE(film_file::write(path_, head_, sheet, {}));
  EXPECT_FALSE(film_file::Reader::open(path_).value().read(found));
}

TEST_F(FilmFile, ReadsWhatItWrote) {
  const std::string bytes = written();
  const auto reader = film_file::Reader::open(path_);
  ASSERT_TRUE(reader) << reader.error().message;
  const FilmHead& head = reader.value().head();
  EXPECT_EQ(head.facts, head_.facts);
  EXPECT_EQ(head.share, head_.share);
  EXPECT_EQ(head.metadata, head_.metadata);
  EXPECT_EQ(head.blocks, head_.blocks);
  EXPECT_EQ(head.rect, head_.rect);
  EXPECT_EQ(head.frame_width, 50);
  EXPECT_EQ(head.frame_height, 40);
  EXPECT_EQ(head.spp, 9);
  EXPECT_TRUE(head.transparent);
  EXPECT_EQ(head.order, PixelOrder::frameless);
  PartSheet sheet(head.rect, head.kinds);
  ASSERT_TRUE(reader.value().read(sheet));
  ASSERT_TRUE(film_file::write(path_, head, sheet, {}));
  EXPECT_EQ(read_bytes(path_), bytes);
  EXPECT_EQ(sheet.film().samples(3, 4), 9);
  EXPECT_EQ(sheet.film().samples(20, 4), 0);
}

TEST_F(FilmFile, EveryCutIsRefused) {
  const std::string bytes = written();
  for (std::size_t length = 0; length < bytes.size(); length += length < 128 ? 1 : 331)
    EXPECT_NE(refusal(bytes.substr(0, length)), "") << length;
  EXPECT_THAT(refusal(bytes.substr(0, bytes.size() - 1)), HasSubstr("is cut off: it has "));
  EXPECT_THAT(refusal(bytes.substr(0, 10)), HasSubstr("no film file"));
}

TEST_F(FilmFile, EveryChangedByteIsRefused) {
  const std::string bytes = written();
  for (std::size_t at = 0; at < bytes.size(); at += at < 128 ? 1 : 331) {
    for (const char flip : {'\x01', '\x80'}) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ flip);
      EXPECT_NE(refusal(changed), "") << at;
    }
  }
  EXPECT_THAT(refusal(bytes + "x"), HasSubstr("was changed"));
}

TEST_F(FilmFile, OtherVersionsAreNamed) {
  std::string bytes = written();
  bytes[8] = 3;
  EXPECT_EQ(refusal(bytes), "is a film file of version 3, expected 4");
}

TEST_F(FilmFile, ImpossibleSamplesAreRefused) {
  PartSheet sheet(head_.rect, head_.kinds);
  const PixelRect pixel{3, 4, 4, 5};
  for (const FilmPixel& bad : {FilmPixel{-1, 0, 0, 1, 0}, FilmPixel{1, 1, 1, -1, 0},
                               FilmPixel{1, 1, 1, 2, 511}, FilmPixel{0, 1 / 0.0, 0, 1, 0}}) {
    std::string text(reinterpret_cast<const char*>(&bad), sizeof bad);
    text.resize(head_.kinds.pixel_bytes());
    EXPECT_FALSE(sheet.take(pixel, text));
  }
}

}  // namespace
}  // namespace boule::test
