#pragma once

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>

namespace boule {

/// Writes bytes one after the other to an open file. It buffers them. After a failure it keeps the
/// errno code and drops later bytes. After its construction it throws nothing, because libraries in
/// C call it.
class ByteSink {
 public:
  explicit ByteSink(int descriptor)
      : descriptor_(descriptor), gathered_(std::make_unique<unsigned char[]>(room)) {}

  void add(const unsigned char* bytes, std::size_t count) noexcept {
    while (count > 0) {
      const std::size_t part = std::min(count, room - size_);
      std::memcpy(gathered_.get() + size_, bytes, part);
      size_ += part;
      bytes += part;
      count -= part;
      if (size_ == room) flush();
    }
  }
  /// Writes the buffered bytes.
  void flush() noexcept {
    for (std::size_t done = 0; done < size_ && code_ == 0;) {
      const ssize_t written = ::write(descriptor_, gathered_.get() + done, size_ - done);
      if (written > 0) {
        done += static_cast<std::size_t>(written);
      } else if (written == 0 || errno != EINTR) {
        code_ = written == 0 ? EIO : errno;
      }
    }
    size_ = 0;
  }
  /// The errno code of the first failure so far, or 0.
  [[nodiscard]] int code() const { return code_; }

 private:
  static constexpr std::size_t room = 1 << 16;

  int descriptor_;
  int code_ = 0;
  std::size_t size_ = 0;
  std::unique_ptr<unsigned char[]> gathered_;
};

}  // namespace boule
