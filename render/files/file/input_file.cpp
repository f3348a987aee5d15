#include "render/files/file/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/base/memory_pages.h"
#include "render/memory/available_memory.h"

namespace boule {

Diagnostic cannot_read(const std::string& path, const std::string& reason) {
  return Diagnostic::in_file(path, "cannot read it: " + reason);
}

namespace {

std::string system_reason() { return std::generic_category().message(errno); }

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

Status refuse_special(const std::string& path, const struct stat& info) {
  if (S_ISREG(info.st_mode)) return {};
  return cannot_read(path,
                     std::string("it is ") + kind_of(info.st_mode) + ", expected a regular file");
}

/// Refuses bytes that are not text, with the place of the first NUL byte; there is none before
/// `checked`.
Status refuse_binary(const std::string& path, std::string_view text, std::size_t checked) {
  const std::string_view start = text.substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff") {
    return Diagnostic{
        .message = "is UTF-16 text, expected UTF-8", .file = path, .line = 1, .column = 1};
  }
  const std::size_t nul = text.find('\0', checked);
  if (nul == std::string_view::npos) return {};
  const std::string_view before = text.substr(0, nul);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
  return Diagnostic{.message = "holds a NUL byte, expected UTF-8 text",
                    .file = path,
                    .line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
                    .column = 1 + static_cast<int>(nul - line_start)};
}

/// Appends up to `count` bytes of the file and returns true if the file ends with them. Bytes that
/// are not text are refused.
Result<bool> append_text(InputFile& file, const std::string& path, std::size_t count,
                         std::string& text) {
  const std::size_t begin = text.size();
  text.resize(begin + count);
  const auto got = file.read(text.data() + begin, count);
  if (!got) return got.error();
  text.resize(begin + got.value());
  if (auto done = refuse_binary(path, text, begin); !done) return done.error();
  return got.value() < count;
}

}  // namespace

InputFile::InputFile(std::string path, int descriptor, std::uint64_t size)
    : path_(std::move(path)), descriptor_(descriptor), size_(size) {}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  InputFile taken(std::move(other));  // takes along what this one had
  std::swap(path_, taken.path_);
  std::swap(descriptor_, taken.descriptor_);
  std::swap(size_, taken.size_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<InputFile> InputFile::open(const std::string& path) {
  if (path.find('\0') != std::string::npos) return cannot_read(path, "its name holds a NUL byte");
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0) return cannot_read(path, system_reason());
  if (auto done = refuse_special(path, info); !done) return done.error();
  // O_NONBLOCK: if the file has become a FIFO meanwhile, opening it must not wait for a writer.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return cannot_read(path, system_reason());
  InputFile file(path, descriptor, 0);
  if (::fstat(descriptor, &info) != 0) return cannot_read(path, system_reason());
  if (auto done = refuse_special(path, info); !done) return done.error();
  file.size_ = static_cast<std::uint64_t>(info.st_size);
  return file;
}

Result<InputFile> InputFile::standard_input() {
  const int descriptor = ::fcntl(0, F_DUPFD_CLOEXEC, 0);
  if (descriptor < 0) return cannot_read("standard input", system_reason());
  return InputFile("standard input", descriptor, 0);
}

/// Calls get(to, count) until `count` bytes are there, or the file ends.
template <class Get>
Result<std::size_t> InputFile::read_all(void* buffer, std::size_t count, const Get& get) const {
  if (descriptor_ < 0) return cannot_read(path_, "it was moved away");
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = get(static_cast<char*>(buffer) + done, count - done, done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return cannot_read(path_, system_reason());
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

Result<std::size_t> InputFile::read(void* buffer, std::size_t count) {
  return read_all(buffer, count, [this](char* to, std::size_t left, std::size_t) {
    return ::read(descriptor_, to, left);
  });
}

Result<std::size_t> InputFile::read_at(std::uint64_t begin, void* buffer, std::size_t count) const {
  return read_all(buffer, count, [this, begin](char* to, std::size_t left, std::size_t done) {
    return ::pread(descriptor_, to, left, static_cast<off_t>(begin + done));
  });
}

Result<std::string> read_text(const std::string& path) {
  // Each block is cleared and then read while it is in the cache, which cannot hold the whole text.
  constexpr std::size_t block_size = std::size_t{1} << 18;
  auto file = InputFile::open(path);
  if (!file) return file.error();
  const std::uint64_t size = file.value().size();
  std::string text;
  // The first block is read before memory is allocated for the rest: a binary file needs none.
  auto at_end = append_text(file.value(), path, block_size, text);
  if (!at_end) return at_end.error();
  if (!at_end.value() && size > text.size()) {
    if (const auto done = check_memory(size, "it needs"); !done)
      return cannot_read(path, done.error().message);
    text.reserve(static_cast<std::size_t>(size));
    prefer_huge_pages(text.data(), static_cast<std::size_t>(size));
  }
  while (!at_end.value() && text.size() < size) {
    const std::uint64_t left = size - text.size();
    at_end = append_text(file.value(), path,
                         static_cast<std::size_t>(std::min<std::uint64_t>(block_size, left)), text);
    if (!at_end) return at_end.error();
  }
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
  return text;
}

}  // namespace boule
