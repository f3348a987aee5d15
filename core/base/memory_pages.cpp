#include "core/base/memory_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace boule {
namespace {

#ifdef __linux__
constexpr int huge = MADV_HUGEPAGE, unused = MADV_DONTNEED;
#else
constexpr int huge = POSIX_MADV_NORMAL, unused = POSIX_MADV_NORMAL;
#endif

/// Advises the system about the whole pages in a piece of memory.
void advise(void* memory, std::size_t bytes, int advice) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  if (std::align(page, page, memory, bytes) != nullptr) {
    ::madvise(memory, bytes / page * page, advice);
  }
}

std::size_t rounded_up(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

std::size_t in_pages(std::size_t bytes) {
  return rounded_up(bytes, static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
}

void* map_anywhere(std::size_t bytes) {
  void* const map =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return map == MAP_FAILED ? nullptr : map;
}

/// `bytes` bytes in whole pages, of which the first begins a huge page if they fill one and if the
/// address space has room.
void* map_aligned(std::size_t bytes) {
  constexpr std::size_t huge_page = std::size_t{2} << 20;
  if (bytes < huge_page) return map_anywhere(bytes);
  void* const map = map_anywhere(bytes + huge_page);
  if (map == nullptr) return map_anywhere(bytes);
  const auto at = reinterpret_cast<std::uintptr_t>(map);
  const std::size_t before = rounded_up(at, huge_page) - at;
  char* const begin = static_cast<char*>(map) + before;
  if (before > 0) ::munmap(map, before);
  ::munmap(begin + bytes, huge_page - before);
  return begin;
}

}  // namespace

void prefer_huge_pages(void* memory, std::size_t bytes) {
  // Smaller blocks share their pages with other data, and gain little.
  constexpr std::size_t least = std::size_t{8} << 20;
  if (bytes >= least) advise(memory, bytes, huge);
}

void release_pages(void* memory, std::size_t bytes) { advise(memory, bytes, unused); }

void touch_pages(void* memory, std::size_t bytes, const ParallelFor& parallel_for) {
  constexpr std::size_t page = 4096, piece = std::size_t{2} << 20;
  parallel_for((bytes + piece - 1) / piece, [&](std::size_t i) {
    const std::size_t end = std::min((i + 1) * piece, bytes);
    volatile char* const at = static_cast<char*>(memory);
    for (std::size_t offset = i * piece; offset < end; offset += page) at[offset] = 0;
  });
}

void* take_pages(std::size_t bytes) {
  void* const memory = map_aligned(in_pages(bytes));
  if (memory != nullptr) prefer_huge_pages(memory, in_pages(bytes));
  return memory;
}

void* resize_pages(void* memory, std::size_t bytes, std::size_t wanted) {
  const std::size_t old_size = in_pages(bytes), new_size = in_pages(wanted);
  if (::mremap(memory, old_size, new_size, 0) != MAP_FAILED) return memory;
  void* const other = map_aligned(new_size);
  if (other == nullptr) {  // in a small address space there may be only one place with room
    void* const moved = ::mremap(memory, old_size, new_size, MREMAP_MAYMOVE);
    return moved == MAP_FAILED ? nullptr : moved;
  }
  if (::mremap(memory, old_size, new_size, MREMAP_MAYMOVE | MREMAP_FIXED, other) == MAP_FAILED) {
    ::munmap(other, new_size);
    return nullptr;
  }
  prefer_huge_pages(other, new_size);
  return other;
}

void give_back_pages(void* memory, std::size_t bytes) { ::munmap(memory, in_pages(bytes)); }

}  // namespace boule
