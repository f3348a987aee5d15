#include "render/frame/memory.h"

#include <unistd.h>

#include <fstream>
#include <limits>
#include <string>

namespace boule {
namespace {

/// "MemAvailable" of Linux, in bytes, or 0.
std::uint64_t linux_available() {
  std::ifstream info("/proc/meminfo");
  std::string name, unit;
  std::uint64_t kibibytes = 0;
  while (info >> name >> kibibytes) {
    std::getline(info, unit);
    if (name == "MemAvailable:") return kibibytes * 1024;
  }
  return 0;
}

}  // namespace

std::uint64_t available_memory() {
  if (const std::uint64_t bytes = linux_available(); bytes > 0) return bytes;
  const long pages = sysconf(_SC_PHYS_PAGES), page_size = sysconf(_SC_PAGE_SIZE);
  if (pages <= 0 || page_size <= 0) return std::numeric_limits<std::uint64_t>::max();
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
}

}  // namespace boule
