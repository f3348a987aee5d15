#pragma once

#include <string>

#include "core/base/error.h"

namespace boule::cli {

/// A lock file that one process holds at a time. The system's lock on it ends with the process,
/// however that ends; the file says who holds it.
class FileLock {
 public:
  /// Makes the file, or takes the one that is there and that nobody holds. The Diagnostic says who
  /// holds it, or what the system said.
  static Result<FileLock> take(const std::string& path);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  /// Removes the file, unless another one has its name.
  ~FileLock();

 private:
  FileLock(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::string path_;
  int descriptor_ = -1;
};

/// Tries to lock an open file for this process alone; 0 or an errno code.
int lock_file(int descriptor);

/// The text of a small open file.
std::string small_text(int descriptor);

/// Replaces the text of a small open file; false if that fails.
bool replace_text(int descriptor, const std::string& text);

/// Whether the open file is still the one of that name.
bool has_name(int descriptor, const std::string& path);

}  // namespace boule::cli
