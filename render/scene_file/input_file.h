#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/error.h"

namespace boule {

/// A regular file open for reading; closes itself. Anything else (directory, FIFO, device, socket)
/// is refused before it is opened, so that opening neither blocks nor acts.
class InputFile {
 public:
  /// Opens `path`, any name; the error carries the system's reason.
  static Result<InputFile> open(const std::string& path);

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  /// Its size in bytes when it was opened.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// Reads up to `count` bytes into `buffer`, which has room for them: how many, less than `count`
  /// only at the end. An error of a file that was moved away.
  Result<std::size_t> read(void* buffer, std::size_t count);

 private:
  InputFile(std::string path, int descriptor, std::uint64_t size);

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// The whole text of a regular file, without a UTF-8 byte order mark. UTF-16 text and NUL bytes
/// are refused, the latter with their place, as soon as they are read: of a file that is all zeros
/// its first block. So is what does not fit into memory.
Result<std::string> read_text(const std::string& path);

}  // namespace boule
