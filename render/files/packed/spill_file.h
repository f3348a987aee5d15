#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/error.h"

namespace boule {

/// A temporary file without a name in a folder, for what does not fit into memory: nothing is left
/// of it however the program ends. A SpillFile that was moved away must not be used.
class SpillFile {
 public:
  /// In the folder of the file `beside`, any name. The Diagnostic (cannot_write) has the system's
  /// reason.
  static Result<SpillFile> create(const std::string& beside);

  SpillFile(SpillFile&& other) noexcept;
  SpillFile& operator=(SpillFile&& other) noexcept;
  ~SpillFile();

  [[nodiscard]] std::uint64_t size() const { return size_; }

  Status append(const void* bytes, std::size_t count);
  /// Precondition of these: the bytes lie within the file.
  Status write(std::uint64_t offset, const void* bytes, std::size_t count);
  Status read(std::uint64_t offset, void* bytes, std::size_t count) const;
  /// Gives the disk these bytes back, where the file system can do that.
  void forget(std::uint64_t offset, std::uint64_t count);
  /// Empties it.
  Status clear();

 private:
  SpillFile(std::string name, int descriptor) : name_(std::move(name)), descriptor_(descriptor) {}

  std::string name_;  ///< of the file beside it, for messages
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace boule
