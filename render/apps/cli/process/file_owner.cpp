#include "render/apps/cli/process/file_owner.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/base/error.h"

namespace boule::cli {
namespace {

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

std::string host_name() {
  std::array<char, HOST_NAME_MAX + 1> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string this_system() {
  std::error_code ignored;
  const auto space = std::filesystem::read_symlink("/proc/self/ns/pid", ignored);
  return first_line("/proc/sys/kernel/random/boot_id") + "/" + space.string();
}

/// Field `wanted`, from 3 on, of /proc/PID/stat; the name in field 2 may hold anything, but ends at
/// the last ')'.
std::string stat_of(int process, int wanted) {
  const std::string line = first_line("/proc/" + std::to_string(process) + "/stat");
  std::istringstream rest(line.substr(std::min(line.rfind(')') + 1, line.size())));
  std::string field;
  for (int i = 3; i <= wanted && rest >> field; ++i) {
  }
  return rest ? field : "";
}

constexpr int state_field = 3, start_field = 22;

}  // namespace

FileOwner FileOwner::self() {
  const int process = getpid();
  return {host_name(), this_system(), process, stat_of(process, start_field),
          fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)))};
}

FileOwner FileOwner::parse(const std::string& text) {
  std::istringstream lines(text);
  FileOwner owner;
  std::string process, end;
  const auto next = [&lines](std::string& field) {
    return static_cast<bool>(std::getline(lines, field));
  };
  if (!next(owner.host) || !next(owner.processes) || !next(process) || !next(owner.started) ||
      !next(owner.time))
    return {};
  const auto [rest, error] =
      std::from_chars(process.data(), process.data() + process.size(), owner.process);
  const bool is_number = error == std::errc{} && *rest == '\0' && owner.process > 0;
  return is_number ? owner : FileOwner{};
}

std::string FileOwner::text() const {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n", host, processes, process, started, time);
}

bool FileOwner::is_gone() const {
  if (process <= 0 || processes != this_system()) return false;
  if (kill(process, 0) != 0 && errno == ESRCH) return true;
  if (stat_of(process, state_field) == "Z") return true;  // ended, and not yet waited for
  const std::string now = stat_of(process, start_field);
  return !now.empty() && !started.empty() && now != started;
}

std::string FileOwner::described() const {
  return fmt::format("process {} on {} since {}", process, printable(host, 64),
                     printable(time, 40));
}

}  // namespace boule::cli
