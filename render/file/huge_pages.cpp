#include "render/file/huge_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <memory>

namespace boule {

void prefer_huge_pages(void* memory, std::size_t bytes) {
#ifdef MADV_HUGEPAGE  // Linux
  // Smaller blocks share their pages with other things, and have little to gain.
  constexpr std::size_t least = std::size_t{8} << 20;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  if (bytes < least || std::align(page, page, memory, bytes) == nullptr) return;
  ::madvise(memory, bytes / page * page, MADV_HUGEPAGE);
#else
  static_cast<void>(memory), static_cast<void>(bytes);
#endif
}

}  // namespace boule
