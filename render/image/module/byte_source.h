#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>

namespace boule {

/// Reads bytes one after the other from a file. After a failure it keeps the errno code.
class ByteSource {
 public:
  explicit ByteSource(const char* path) : descriptor_(::open(path, O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) code_ = errno;
  }
  ~ByteSource() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  /// Reads up to `count` bytes. Returns the number of bytes read: fewer at the end, or after a
  /// failure.
  std::size_t read(void* bytes, std::size_t count) {
    auto* const to = static_cast<char*>(bytes);
    std::size_t done = 0;
    while (done < count && code_ == 0) {
      const ssize_t got = ::read(descriptor_, to + done, count - done);
      if (got > 0) {
        done += static_cast<std::size_t>(got);
      } else if (got == 0) {
        break;
      } else if (errno != EINTR) {
        code_ = errno;
      }
    }
    return done;
  }
  /// The errno code of the first failure so far, or 0.
  [[nodiscard]] int code() const { return code_; }

 private:
  int descriptor_;
  int code_ = 0;
};

}  // namespace boule
