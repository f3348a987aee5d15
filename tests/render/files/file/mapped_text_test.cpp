#include "render/files/file/mapped_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <string>

#include "render/files/file/growing_bytes.h"
#include "render/memory/available_memory.h"
#include "tests/support/file_bytes.h"
#include "tests/support/temp_dir.h"

namespace boule {
namespace {

using test::TempDir;
using testing::HasSubstr;

/// "hello\n", packed by gzip -n, zstd, bzip2 and xz.
const std::string gzip_hello(
    "\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\xcb\x48\xcd\xc9\xc9\xe7\x02\x00\x20\x30\x3a\x36\x06"
    "\x00\x00\x00",
    26);
const std::string zstd_hello(
    "\x28\xb5\x2f\xfd\x24\x06\x31\x00\x00\x68\x65\x6c\x6c\x6f\x0a\x53\x88\xbd\x91", 19);

const std::string bzip2_hello(
    "\x42\x5a\x68\x39\x31\x41\x59\x26\x53\x59\xc1\xc0\x80\xe2\x00\x00\x01\x41\x00\x00\x10\x02\x44"
    "\xa0\x00\x30\xcd\x00\xc3\x46\x29\x97\x17\x72\x45\x38\x50\x90\xc1\xc0\x80\xe2",
    42);
const std::string xz_hello(
    "\xfd\x37\x7a\x58\x5a\x00\x00\x04\xe6\xd6\xb4\x46\x02\x00\x21\x01\x16\x00\x00\x00\x74\x2f\xe5"
    "\xa3\x01\x00\x05\x68\x65\x6c\x6c\x6f\x0a\x00\x00\x00\xa5\x60\x97\xf1\x94\xf6\xfd\xe0\x00\x01"
    "\x1e\x06\xc1\x2f\xa4\x1d\x1f\xb6\xf3\x7d\x01\x00\x00\x00\x00\x04\x59\x5a",
    64);

/// What a file of these bytes is read as, or the error.
std::string text_of(const std::string& bytes) {
  const TempDir folder;
  const std::string path = folder.path() / "file";
  test::write_bytes(path, bytes);
  auto opened = MappedText::open(path);
  if (!opened) {
    EXPECT_EQ(opened.error().file, path);
    return opened.error().message;
  }
  const MappedText moved = std::move(opened).value();
  return std::string(moved.text());
}

/// Zstandard's bytes for so many blocks of 128 KiB of "a", without their length in the header.
std::string zstd_repeated(std::size_t blocks) {
  std::string bytes("\x28\xb5\x2f\xfd\x00\x38", 6);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::uint32_t header = (i + 1 == blocks ? 1U : 0U) | 1U << 1 | 0x20000U << 3;
    for (int shift = 0; shift < 24; shift += 8) bytes += static_cast<char>(header >> shift & 255);
    bytes += 'a';
  }
  return bytes;
}

TEST(MappedText, ReadsPlainBytes) {
  EXPECT_EQ(text_of("hello\n"), "hello\n");
  EXPECT_EQ(text_of(""), "");
  EXPECT_EQ(text_of("\xef\xbb\xbfhello"), "hello");
  EXPECT_EQ(text_of(std::string("a\0b", 3)), std::string("a\0b", 3));
}

TEST(MappedText, MapsLargeFiles) {
  std::string large(std::size_t{17} << 20, 'x');
  large.back() = 'y';
  EXPECT_EQ(text_of(large), large);
}

TEST(MappedText, HoldsTextsOfItsOwn) {
  MappedText first = MappedText::of("\xef\xbb\xbfshort");
  const MappedText second = std::move(first);
  EXPECT_EQ(second.text(), "short");
}

TEST(MappedText, UnpacksAllMembersAndFrames) {
  EXPECT_EQ(text_of(gzip_hello), "hello\n");
  EXPECT_EQ(text_of(gzip_hello + gzip_hello + std::string(512, '\0')), "hello\nhello\n");
  EXPECT_EQ(text_of(zstd_hello), "hello\n");
  for (const std::string& packed : {bzip2_hello, xz_hello}) {
    EXPECT_EQ(text_of(packed), "hello\n");
    EXPECT_EQ(text_of(packed + packed + std::string(512, '\0')), "hello\nhello\n");
  }
  const std::string skipped("\x50\x2a\x4d\x18\x02\x00\x00\x00zz", 10);
  EXPECT_EQ(text_of(skipped + zstd_hello + skipped + zstd_hello), "hello\nhello\n");
  EXPECT_EQ(text_of(zstd_repeated(100)), std::string(100 << 17, 'a'));
}

TEST(MappedText, RefusesDamage) {
  for (const std::string& packed : {gzip_hello, zstd_hello, bzip2_hello, xz_hello}) {
    const std::size_t mark = packed == xz_hello ? 6 : 4;  // what tells the packer
    for (std::size_t size = mark; size < packed.size(); ++size) {
      EXPECT_THAT(text_of(packed.substr(0, size)), HasSubstr("are damaged: the file ends before"));
    }
    std::string changed = packed;
    changed[changed.size() - 8] ^= 1;
    EXPECT_THAT(text_of(changed), HasSubstr("data are damaged: "));
    EXPECT_THAT(text_of(packed + "more"), HasSubstr("data are damaged: "));
  }
}

TEST(MappedText, RefusesWhatCannotBeRead) {
  const TempDir folder;
  for (const std::string path : {folder.path() / "none", folder.path()}) {
    const auto opened = MappedText::open(path);
    ASSERT_FALSE(opened.ok());
    EXPECT_THAT(opened.error().message, HasSubstr("cannot read it"));
  }
}

/// Lowers the limit on this process's memory for as long as it lives.
class AddressLimit {
 public:
  explicit AddressLimit(rlim_t bytes) {
    getrlimit(RLIMIT_AS, &saved_);
    const rlimit limit{bytes, saved_.rlim_max};
    set_ = setrlimit(RLIMIT_AS, &limit) == 0;
  }
  AddressLimit(const AddressLimit&) = delete;
  AddressLimit& operator=(const AddressLimit&) = delete;
  ~AddressLimit() { setrlimit(RLIMIT_AS, &saved_); }
  [[nodiscard]] bool set() const { return set_; }

 private:
  rlimit saved_{};
  bool set_ = false;
};

TEST(MappedText, RefusesABombWithOneError) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "its shadow needs all addresses";
#endif
  const std::string bomb = zstd_repeated(1000000);  // 122 GiB
  const AddressLimit limit(rlim_t{1} << 30);
  if (!limit.set()) GTEST_SKIP() << "the limit cannot be set";
  EXPECT_THAT(text_of(bomb), HasSubstr("unpacked, it needs another "));
  // One that tells its length is refused at once.
  std::string honest("\x28\xb5\x2f\xfd\xc0\x38", 6);
  honest += std::string("\0\0\0\0\0\1\0\0", 8) + zstd_repeated(1).substr(6);
  EXPECT_THAT(text_of(honest), HasSubstr("unpacked, it needs 1048576 MiB of memory"));
}

TEST(GrowingBytes, KeepsWhatItHolds) {
  GrowingBytes bytes;
  EXPECT_TRUE(bytes.grow());
  bytes.data()[0] = 'a';
  bytes.set_size(1);
  const std::size_t before = bytes.capacity();
  EXPECT_TRUE(bytes.reserve(std::size_t{64} << 20));
  EXPECT_GT(bytes.capacity(), before);
  GrowingBytes moved = std::move(bytes);
  EXPECT_EQ(moved.size(), 1U);
  EXPECT_EQ(moved.data()[0], 'a');
  EXPECT_EQ(moved.data()[moved.capacity() - 1], '\0');
}

}  // namespace
}  // namespace boule
