#include "core/base/memory_pages.h"

#include <sys/mman.h>
#include <unistd.h>

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

}  // namespace

void prefer_huge_pages(void* memory, std::size_t bytes) {
  // Smaller blocks share their pages with other things, and have little to gain.
  constexpr std::size_t least = std::size_t{8} << 20;
  if (bytes >= least) advise(memory, bytes, huge);
}

void release_pages(void* memory, std::size_t bytes) { advise(memory, bytes, unused); }

}  // namespace boule
