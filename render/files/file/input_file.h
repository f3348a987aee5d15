#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/error.h"

namespace boule {

/// What every refusal to read a file says.
Diagnostic cannot_read(const std::string& path, const std::string& reason);

/// A regular file open for reading; the destructor closes it. Directories, FIFOs, devices and
/// sockets are refused before they are opened: opening one could block, or set off an action.
class InputFile {
 public:
  /// Opens `path`, any name; the error carries the system's reason.
  static Result<InputFile> open(const std::string& path);

  /// Standard input, whatever it is. Its size is not known: 0.
  static Result<InputFile> standard_input();

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;
  ~InputFile();

  /// Its size in bytes when it was opened.
  [[nodiscard]] std::uint64_t size() const { return size_; }

  /// The system's number for the open file, which stays this object's; -1 once it was moved away.
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Reads up to `count` bytes into `buffer`, which has room for them. Returns how many it read:
  /// less than `count` at the end of the file only. An error for a file that was moved away.
  Result<std::size_t> read(void* buffer, std::size_t count);
  /// The same from byte `begin` of the file on, whatever read() has read. Several threads may do so
  /// at the same time.
  Result<std::size_t> read_at(std::uint64_t begin, void* buffer, std::size_t count) const;

 private:
  template <class Get>
  Result<std::size_t> read_all(void* buffer, std::size_t count, const Get& get) const;
  InputFile(std::string path, int descriptor, std::uint64_t size);

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// The whole text of a regular file, without a UTF-8 byte order mark. UTF-16 text, NUL bytes and
/// text that does not fit into memory are refused. A NUL byte is refused as soon as it is read,
/// with its line and column: of a file of zeros only the first block is read.
Result<std::string> read_text(const std::string& path);

}  // namespace boule
