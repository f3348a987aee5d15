#include "render/apps/cli/report/output_check.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "render/apps/cli/process/interrupt.h"
#include "render/image/output_file.h"

namespace boule::cli {
namespace {

Diagnostic refusal(const std::string& name, int code) { return cannot_write(name, code); }

/// A pipe or device is written to directly; a socket cannot be opened by its name.
Status check_stream(const std::string& name, mode_t mode) {
  if (S_ISSOCK(mode)) return refusal(name, ENXIO);
  if (faccessat(AT_FDCWD, name.c_str(), W_OK, AT_EACCESS) != 0) return refusal(name, errno);
  return {};
}

/// Tries it out: creates the temporary file that writing would create, and removes it again.
Status check_file(const std::string& name) {
  return write_guarded([&]() -> Status {
    const auto file = OutputFile::create(name, [] { return WriteGuard::interrupted(); });
    return file ? Status() : Status(file.error());
  });
}

}  // namespace

Status check_output(const std::string& name) {
  struct stat info {};
  const bool exists = stat(name.c_str(), &info) == 0;
  const bool is_stream = exists && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
  return is_stream ? check_stream(name, info.st_mode) : check_file(name);
}

Status check_stats_target(const StatsTarget& target) {
  if (target.form != StatsForm::json) return {};
  return target.file == "-" ? check_standard_output() : check_output(target.file);
}

Status check_standard_output() {
  const int flags = fcntl(STDOUT_FILENO, F_GETFL);
  const bool writable = flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
  return writable ? Status() : refusal("standard output", EBADF);
}

}  // namespace boule::cli
