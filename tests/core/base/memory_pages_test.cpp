#include "core/base/memory_pages.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace boule {
namespace {

constexpr std::size_t size = std::size_t{1} << 20;

TEST(MemoryPages, ReleasingKeepsWhatLiesAround) {
  std::vector<unsigned char> bytes(size, 7);
  constexpr std::size_t first = 12'345, end = size - 54'321;
  release_pages(bytes.data() + first, end - first);
  for (std::size_t i = 0; i < first; ++i) ASSERT_EQ(bytes[i], 7) << i;
  for (std::size_t i = end; i < size; ++i) ASSERT_EQ(bytes[i], 7) << i;
}

TEST(MemoryPages, ReleasedMemoryCanBeWrittenAgain) {
  std::vector<unsigned char> bytes(size, 7);
  release_pages(bytes.data(), size);
  bytes.assign(size, 8);
  for (const unsigned char byte : bytes) ASSERT_EQ(byte, 8);
}

TEST(MemoryPages, LessThanAPageIsKept) {
  std::vector<unsigned char> bytes(100, 7);
  release_pages(bytes.data(), bytes.size());
  prefer_huge_pages(bytes.data(), bytes.size());
  for (const unsigned char byte : bytes) ASSERT_EQ(byte, 7);
}

}  // namespace
}  // namespace boule
