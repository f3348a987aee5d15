#include "render/image/output_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <system_error>
#include <utility>

namespace boule {
namespace {

/// "dir/" of "dir/name", or empty.
std::string folder_of(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }

/// Whether somebody else may have made this link, to have us write where they could not. In a
/// folder like /tmp only links of our own or of the folder's owner are followed, as by the kernel
/// where fs.protected_symlinks is set.
bool is_trap(const std::string& link) {
  struct stat folder {
  }, own{};
  const std::string name = folder_of(link).empty() ? "." : folder_of(link);
  if (stat(name.c_str(), &folder) != 0 || lstat(link.c_str(), &own) != 0) return false;
  const bool anybodys = (folder.st_mode & S_ISVTX) != 0 && (folder.st_mode & S_IWOTH) != 0;
  return anybodys && S_ISLNK(own.st_mode) && own.st_uid != geteuid() && own.st_uid != folder.st_uid;
}

/// Replaces `path` by the file at the end of its chain of symbolic links, which need not exist.
/// Returns 0 or an errno code.
int follow_links(std::string& path) {
  constexpr int longest_chain = 40;  // the kernel's own limit
  for (int links = 0; links <= longest_chain; ++links) {
    std::array<char, PATH_MAX> text{};
    const ssize_t length = readlink(path.c_str(), text.data(), text.size());
    if (length < 0) return errno == EINVAL || errno == ENOENT ? 0 : errno;
    if (is_trap(path)) return EACCES;
    const std::string link(text.data(), static_cast<std::size_t>(length));
    path = link.starts_with('/') ? link : folder_of(path) + link;
  }
  return ELOOP;
}

/// ".STEM.XXXXXX.temp.EXT" beside the target, with random X. It keeps the extension, because
/// programs choose a format by it. A long stem is cut, so that any legal name has a legal temporary
/// one.
std::string temporary_name(const std::string& target) {
  constexpr char digits[] = "0123456789abcdefghijklmnopqrstuv";
  const std::string folder = folder_of(target);
  const std::string base = target.substr(folder.size());
  const std::size_t dot = std::min(base.rfind('.'), base.size());
  std::uint64_t bits = 0;
  // If there is too little entropy, the name may be in use, and there is another attempt.
  [[maybe_unused]] const ssize_t got = getrandom(&bits, sizeof bits, GRND_NONBLOCK);
  std::string tag;
  for (int i = 0; i < 6; ++i, bits >>= 5) tag += digits[bits & 31];
  const std::string tail = "." + tag + ".temp" + base.substr(dot);
  const std::size_t room = tail.size() < NAME_MAX ? NAME_MAX - 1 - tail.size() : 0;
  return folder + "." + base.substr(0, std::min(dot, room)) + tail;
}

/// How long to wait for something slow before `stop` is asked again.
constexpr int patience_ms = 100;

/// Opens a pipe or device without blocking. If a FIFO has no reader, waits for one. Returns the
/// descriptor, or -1 with errno set: to ECANCELED if `stop` returned true.
int open_stream(const std::string& path, bool is_fifo, const std::function<bool()>& stop) {
  for (;;) {
    const int stream = open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (stream >= 0 || errno != ENXIO || !is_fifo) return stream;
    if (stop && stop()) {
      errno = ECANCELED;
      return -1;
    }
    poll(nullptr, 0, patience_ms);
  }
}

/// Writes all bytes to a file, or to a pipe or device that does not block, as its reader takes
/// them. Returns 0 or an errno code: ECANCELED if `stop` returned true.
int write_all(int stream, const char* bytes, std::size_t count, const std::function<bool()>& stop) {
  while (count > 0) {
    if (stop && stop()) return ECANCELED;
    pollfd ready{stream, POLLOUT, 0};
    if (poll(&ready, 1, patience_ms) == 0) continue;
    const ssize_t written = ::write(stream, bytes, count);
    if (written < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (written < 0) return errno;
    if (written == 0) return EIO;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return 0;
}

/// How many random names are tried; each may be in use.
constexpr int attempts = 100;

std::string folder_to_open(const std::string& path) {
  const std::string folder = folder_of(path);
  return folder.empty() ? "." : folder;
}

/// Makes the new name survive a power cut, by writing its folder to the disk. Not every file system
/// can do that, so a failure is ignored.
void sync_folder(const std::string& path) {
  const int descriptor = open(folder_to_open(path).c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

Diagnostic cannot_write(const std::string& name, const std::string& reason) {
  return Diagnostic::of("cannot write " + quote(name, PATH_MAX) + ": " + reason);
}

Diagnostic cannot_write(const std::string& name, int code) {
  return cannot_write(name, std::generic_category().message(code));
}

Result<OutputFile> OutputFile::create(const std::string& target,
                                      const std::function<bool()>& stop) {
  if (target.find('\0') != std::string::npos) {
    return cannot_write(target, "its name holds a NUL byte");
  }
  OutputFile file;
  file.name_ = target;
  std::string real = target;
  const int link_problem = follow_links(real);
  if (link_problem == EACCES) return cannot_write(target, EACCES);
  struct stat stream {};
  // By the target's own name: what /dev/stdout leads to may have no name.
  if (stat(target.c_str(), &stream) == 0 && !S_ISREG(stream.st_mode) && !S_ISDIR(stream.st_mode)) {
    return create_stream(std::move(file), S_ISFIFO(stream.st_mode), stop);
  }
  if (link_problem != 0) return cannot_write(target, link_problem);
  struct stat old {};
  const bool exists = stat(real.c_str(), &old) == 0;
  if (!exists && (errno != ENOENT || real.empty())) {
    return cannot_write(target, errno);
  }
  if (exists ? S_ISDIR(old.st_mode) : real.ends_with('/')) {
    return cannot_write(target, EISDIR);
  }
  // rename() would replace a write-protected file as well.
  if (exists && faccessat(AT_FDCWD, real.c_str(), W_OK, AT_EACCESS) != 0) {
    return cannot_write(target, errno);
  }
  Result<OutputFile> made = create_beside(std::move(file), real);
  if (made.ok() && exists) fchmod(made.value().descriptor_, old.st_mode & 0777);
  return made;
}

Result<OutputFile> OutputFile::create_beside(OutputFile file, const std::string& real_target) {
  file.real_target_ = real_target;
  if (file.open_unnamed()) return Result<OutputFile>(std::move(file));
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::string path = temporary_name(real_target);
    file.descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file.descriptor_ >= 0) {
      file.path_ = file.temporary_ = path;
      return Result<OutputFile>(std::move(file));
    }
    if (errno != EEXIST) break;
  }
  return cannot_write(file.name_, errno);
}

/// Opens a file without a name. False if the file system has no such files, or if there is no
/// /proc.
bool OutputFile::open_unnamed() {
  const int descriptor =
      open(folder_to_open(real_target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (descriptor < 0) return false;
  const std::string path = "/proc/self/fd/" + std::to_string(descriptor);
  if (access(path.c_str(), R_OK | W_OK) != 0) {
    close(descriptor);
    return false;
  }
  path_ = path;
  descriptor_ = descriptor;
  return true;
}

/// Gives the temporary file a name. Returns 0 or an errno code.
int OutputFile::give_name() {
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::string name = temporary_name(real_target_);
    if (linkat(AT_FDCWD, path_.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      temporary_ = name;
      return 0;
    }
    if (errno != EEXIST) break;
  }
  return errno;
}

Result<OutputFile> OutputFile::create_stream(OutputFile file, bool is_fifo,
                                             const std::function<bool()>& stop) {
  file.stream_ = open_stream(file.name_, is_fifo, stop);
  if (file.stream_ < 0 && errno == ECANCELED) return cannot_write(file.name_, "interrupted");
  if (file.stream_ >= 0) file.descriptor_ = memfd_create("boule", MFD_CLOEXEC);
  if (file.descriptor_ < 0) return cannot_write(file.name_, errno);
  file.path_ = "/proc/self/fd/" + std::to_string(file.descriptor_);
  return Result<OutputFile>(std::move(file));
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : name_(std::move(other.name_)),
      real_target_(std::move(other.real_target_)),
      path_(std::exchange(other.path_, {})),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)),
      stream_(std::exchange(other.stream_, -1)),
      synced_(std::exchange(other.synced_, false)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  OutputFile taken(std::move(other));  // its destructor discards what this one had
  std::swap(name_, taken.name_);
  std::swap(real_target_, taken.real_target_);
  std::swap(path_, taken.path_);
  std::swap(temporary_, taken.temporary_);
  std::swap(descriptor_, taken.descriptor_);
  std::swap(stream_, taken.stream_);
  std::swap(synced_, taken.synced_);
  return *this;
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
  if (stream_ >= 0) close(stream_);
  path_.clear();
  temporary_.clear();
  descriptor_ = stream_ = -1;
}

Status OutputFile::write(const void* bytes, std::size_t count) {
  synced_ = false;
  const int code =
      descriptor_ < 0 ? EBADF : write_all(descriptor_, static_cast<const char*>(bytes), count, {});
  if (code != 0) return cannot_write(name_, code);
  return {};
}

Status OutputFile::rewrite_start(const void* bytes, std::size_t count) {
  if (descriptor_ < 0) return cannot_write(name_, EBADF);
  if (lseek(descriptor_, 0, SEEK_SET) < 0) return cannot_write(name_, errno);
  if (auto done = write(bytes, count); !done) return done;
  if (lseek(descriptor_, 0, SEEK_END) < 0) return cannot_write(name_, errno);
  return {};
}

Status OutputFile::sync() {
  if (stream_ >= 0 || (synced_ && descriptor_ >= 0)) return {};
  if (fsync(descriptor_) != 0) return cannot_write(name_, errno);
  synced_ = true;
  return {};
}

Status OutputFile::commit(const std::function<bool()>& stop) {
  if (stream_ >= 0) return commit_stream(stop);
  if (auto done = sync(); !done) return done;
  if (stop && stop()) return cannot_write(name_, "interrupted");
  if (temporary_.empty()) {
    if (const int code = give_name()) return cannot_write(name_, code);
  }
  if (close(std::exchange(descriptor_, -1)) != 0) {
    return cannot_write(name_, errno);
  }
  if (rename(temporary_.c_str(), real_target_.c_str()) != 0) {
    return cannot_write(name_, errno);
  }
  path_.clear();
  temporary_.clear();
  sync_folder(real_target_);
  return {};
}

Status OutputFile::commit_stream(const std::function<bool()>& stop) {
  std::array<char, 1 << 16> buffer;
  off_t position = 0;
  for (;;) {
    const ssize_t count = pread(descriptor_, buffer.data(), buffer.size(), position);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot_write(name_, errno);
    if (count == 0) break;
    const int code = write_all(stream_, buffer.data(), static_cast<std::size_t>(count), stop);
    if (code == ECANCELED) return cannot_write(name_, "interrupted");
    if (code != 0) return cannot_write(name_, code);
    position += count;
  }
  close(std::exchange(descriptor_, -1));  // frees the memory in which the data were gathered
  path_.clear();
  if (close(std::exchange(stream_, -1)) != 0) return cannot_write(name_, errno);
  return {};
}

}  // namespace boule
