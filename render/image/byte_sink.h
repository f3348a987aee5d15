#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <vector>

namespace boule {

/// Writes bytes one after the other to an open file. It gathers them first. After a failure it
/// keeps the errno code and drops what follows.
class ByteSink {
 public:
  explicit ByteSink(int descriptor) : descriptor_(descriptor) { gathered_.reserve(2 * enough); }

  void add(const unsigned char* bytes, std::size_t count) {
    gathered_.insert(gathered_.end(), bytes, bytes + count);
    if (gathered_.size() >= enough) flush();
  }
  /// Writes what is gathered.
  void flush() {
    for (std::size_t done = 0; done < gathered_.size() && code_ == 0;) {
      const ssize_t written =
          ::write(descriptor_, gathered_.data() + done, gathered_.size() - done);
      if (written > 0) {
        done += static_cast<std::size_t>(written);
      } else if (written == 0 || errno != EINTR) {
        code_ = written == 0 ? EIO : errno;
      }
    }
    gathered_.clear();
  }
  /// The errno code of the first failure so far, or 0.
  [[nodiscard]] int code() const { return code_; }

 private:
  static constexpr std::size_t enough = 1 << 16;

  int descriptor_;
  int code_ = 0;
  std::vector<unsigned char> gathered_;
};

}  // namespace boule
