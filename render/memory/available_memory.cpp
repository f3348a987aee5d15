#include "render/memory/available_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string_view>

namespace boule {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kibibyte = 1024, mebibyte = 1024 * kibibyte;

std::uint64_t bytes_of_pages(long pages) {
  const long page = sysconf(_SC_PAGE_SIZE);
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
}

/// The number after a name in a file with lines "NAME NUMBER ..." and others; 0 if the name is not
/// there.
std::uint64_t number_after(const std::string& path, std::string_view wanted) {
  std::ifstream file(path);
  std::string name, rest;
  std::uint64_t number = 0;
  while (file >> name) {
    if (name == wanted) return file >> number ? number : 0;
    std::getline(file, rest);
  }
  return 0;
}

std::uint64_t system_memory() {
  if (const auto linux_has = number_after("/proc/meminfo", "MemAvailable:"); linux_has > 0)
    return linux_has * kibibyte;
  const long pages = sysconf(_SC_PHYS_PAGES);
  return pages > 0 ? bytes_of_pages(pages) : unlimited;
}

/// Bytes that a limit leaves; `used` is the name, in the status file, of what counts for it, in
/// KiB.
std::uint64_t room_below(__rlimit_resource resource, const std::string& status,
                         std::string_view used) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return limit.rlim_cur -
         std::min<std::uint64_t>(limit.rlim_cur, number_after(status, used) * kibibyte);
}

/// What the control group of the process and all groups around it leave.
std::uint64_t control_groups_memory() {
  std::ifstream file("/proc/self/cgroup");
  std::uint64_t least = unlimited;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("0::/")) continue;  // a line of version 1
    for (std::string group = line.substr(3); !group.empty();
         group.resize(group.rfind('/') == std::string::npos ? 0 : group.rfind('/')))
      least = std::min(least, control_group_memory("/sys/fs/cgroup" + group));
  }
  return least;
}

}  // namespace

std::uint64_t available_memory() {
  return std::min({system_memory(), address_room(), control_groups_memory()});
}

ProcessRoom process_room() {
  const std::string status = "/proc/self/status";
  return {room_below(RLIMIT_AS, status, "VmSize:"), room_below(RLIMIT_DATA, status, "VmData:")};
}

std::uint64_t address_room() {
  const ProcessRoom room = process_room();
  return std::min(room.addresses, room.data);
}

std::uint64_t control_group_memory(const std::string& folder) {
  std::uint64_t limit = 0, used = 0;
  if (!(std::ifstream(folder + "/memory.max") >> limit)) return unlimited;  // or "max"
  std::ifstream(folder + "/memory.current") >> used;
  // The pages of files count as used, but the system gives them up when memory is needed.
  const std::string statistics = folder + "/memory.stat";
  used -= std::min(
      used, number_after(statistics, "active_file") + number_after(statistics, "inactive_file"));
  return limit - std::min(limit, used);
}

std::string memory_text(std::uint64_t bytes) {
  const std::uint64_t whole = bytes / mebibyte + (bytes % mebibyte != 0 ? 1 : 0);
  return std::to_string(whole) + " MiB of memory";
}

Status check_memory(std::uint64_t bytes, const std::string& who, const std::string& key) {
  const std::uint64_t available = available_memory();
  if (bytes <= available) return {};
  Diagnostic error = Diagnostic::about(
      key, who + " " + memory_text(bytes) + ", there are " + std::to_string(available / mebibyte));
  error.of_memory = true;
  return error;
}

}  // namespace boule
