#include "core/base/memory_pages.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace boule::memory_pages {
namespace {

constexpr std::size_t size = std::size_t{1} << 20;

TEST(MemoryPages, ReleasingKeepsNeighbouringBytes) {
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

TEST(MemoryPages, PartialPagesAreKept) {
  std::vector<unsigned char> bytes(100, 7);
  release_pages(bytes.data(), bytes.size());
  prefer_huge_pages(bytes.data(), bytes.size());
  for (const unsigned char byte : bytes) ASSERT_EQ(byte, 7);
}

TEST(MemoryPages, TouchingClearsOnlyItsRange) {
  std::vector<unsigned char> bytes(3 * size, 7);
  touch_pages(bytes.data() + size, size, serial_for);
  for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(bytes[i], 7) << i;
  for (std::size_t i = 2 * size; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], 7) << i;
}

TEST(MemoryPages, ResizedPagesKeepTheirContent) {
  std::size_t bytes = 3 * size;
  auto* memory = static_cast<unsigned char*>(take_pages(bytes));
  ASSERT_NE(memory, nullptr);
  for (std::size_t i = 0; i < bytes; ++i) ASSERT_EQ(memory[i], 0) << i;
  for (std::size_t i = 0; i < size; ++i) memory[i] = static_cast<unsigned char>(i % 251);
  for (const std::size_t wanted : {100 * size, size + 1, 7 * size, size}) {
    memory = static_cast<unsigned char*>(resize_pages(memory, bytes, wanted));
    ASSERT_NE(memory, nullptr);
    bytes = wanted;
    memory[bytes - 1] = static_cast<unsigned char>((bytes - 1) % 251);
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(memory[i], i % 251) << i;
  }
  give_back_pages(memory, bytes);
}

TEST(MemoryPages, FailedGrowthLeavesPagesUnchanged) {
  auto* const memory = static_cast<unsigned char*>(take_pages(size));
  ASSERT_NE(memory, nullptr);
  memory[5] = 9;
  constexpr std::size_t too_much = std::size_t{1} << 60;
  EXPECT_EQ(resize_pages(memory, size, too_much), nullptr);
  EXPECT_EQ(take_pages(too_much), nullptr);
  EXPECT_EQ(memory[5], 9);
  give_back_pages(memory, size);
}

}  // namespace
}  // namespace boule::memory_pages
