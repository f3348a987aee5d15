#include "render/apps/cli/process/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "render/apps/cli/process/file_owner.h"
#include "render/image/output_file.h"

namespace boule::cli {

/// The lock belongs to the open file, not to the process: closing another descriptor keeps it.
int lock_file(int descriptor) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(descriptor, F_OFD_SETLK, &whole) == 0 ? 0 : errno;
}

std::string small_text(int descriptor) {
  std::array<char, 1024> bytes{};
  const ssize_t count = pread(descriptor, bytes.data(), bytes.size(), 0);
  return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

bool replace_text(int descriptor, const std::string& text) {
  return ftruncate(descriptor, 0) == 0 &&
         pwrite(descriptor, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
}

bool has_name(int descriptor, const std::string& path) {
  struct stat open {
  }, named{};
  return fstat(descriptor, &open) == 0 && stat(path.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

/// Its last holder may have removed the file between its opening and its locking: then once more.
Result<FileLock> FileLock::take(const std::string& path) {
  for (;;) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0) return cannot_write(path, errno);
    FileLock lock({}, descriptor);
    const int code = lock_file(descriptor);
    if (code == EAGAIN || code == EACCES) {
      const FileOwner owner = FileOwner::parse(small_text(descriptor));
      const std::string who = owner.process > 0 ? owner.described() : "another process";
      return Diagnostic::of(quote(path) + " is held by " + who);
    }
    if (code != 0) return cannot_write(path, code);
    if (!has_name(descriptor, path)) continue;
    if (!replace_text(descriptor, FileOwner::self().text())) return cannot_write(path, errno);
    lock.path_ = path;
    return lock;
  }
}

FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::exchange(other.path_, {})), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (!path_.empty() && has_name(descriptor_, path_)) unlink(path_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace boule::cli
